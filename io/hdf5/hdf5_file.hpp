// A thin layer over HDF5's C interface, the only place that calls it: handles that close themselves, every call
// checked, HDF5's own error text in the IoError. The library never prints.
//
// Text that may be long is a dataset of fixed length (parallel HDF5 cannot write strings of variable length).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec.hpp"

namespace scree::io {

enum class ElementType { f64, f32, i64, u64, i32, u32, u16, u8 };

// A view of n rows, each of `shape` elements ({}: one number, {3}: a vector, {3, 3}: a matrix, row by row).
struct Rows {
    const void* data = nullptr;
    ElementType type = ElementType::f64;
    std::size_t count = 0;
    std::vector<std::size_t> shape;

    std::size_t elements() const;  // of all rows
    std::size_t row_bytes() const;
};
Rows rows_of(std::span<const double> values);
Rows rows_of(std::span<const float> values);
Rows rows_of(std::span<const std::int64_t> values);
Rows rows_of(std::span<const std::uint64_t> values);
Rows rows_of(std::span<const std::int32_t> values);
Rows rows_of(std::span<const std::uint32_t> values);
Rows rows_of(std::span<const std::uint16_t> values);
Rows rows_of(std::span<const std::uint8_t> values);
Rows rows_of(std::span<const Vec3> values);

// What an attribute or a dataset says about its numbers. `frame` is left out if empty.
struct Meaning {
    std::string_view unit, description, frame = {};
};

// Rows of a chunk of a compressed dataset. One number for all, so that ranks that write whole chunks write the same
// rows of each dataset.
inline constexpr std::size_t kPackedRows = 8192;

// How a dataset is laid out on disk.
struct Layout {
    int gzip = 0;             // level, with shuffle; 0: none
    bool extendible = false;  // rows can be appended and cut
    std::size_t chunk_rows = kPackedRows;
};

// Owns an HDF5 id; closes it.
class Hdf5Id {
  public:
    using Closer = int (*)(std::int64_t);
    Hdf5Id() = default;
    Hdf5Id(std::int64_t id, Closer closer) : id_(id), closer_(closer) {}
    Hdf5Id(Hdf5Id&& other) noexcept : id_(other.id_), closer_(other.closer_) { other.id_ = -1; }
    Hdf5Id& operator=(Hdf5Id&& other) noexcept;
    ~Hdf5Id() { reset(); }
    std::int64_t get() const { return id_; }
    int reset();  // closes now; negative if HDF5 says so

  private:
    std::int64_t id_ = -1;
    Closer closer_ = nullptr;
};

struct DatasetInfo {
    std::string name;  // relative to the group it was listed from: "bodies/position"
    ElementType type = ElementType::f64;
    bool text = false;               // then `type` means nothing
    std::vector<std::size_t> shape;  // rows first; {} for a scalar
    std::string unit, description;
};

class Hdf5Group {
  public:
    Hdf5Group(Hdf5Id id, std::string file, std::string path);

    Hdf5Group group(const std::string& name) const;  // made if it is not there
    Hdf5Group existing_group(const std::string& name) const;
    bool has(const std::string& name) const;  // a group or dataset ("a/b" too)
    void remove(const std::string& name) const;
    // `object` of another file, under a name here: who opens it gets that. `path` starts at the folder of this file.
    void link(const std::string& name, const std::string& path, const std::string& object) const;

    void attribute(const std::string& name, double value) const;
    void attribute(const std::string& name, std::uint64_t value) const;
    void attribute(const std::string& name, std::string_view value) const;
    void attribute(const std::string& name, std::span<const double> values) const;
    void attribute(const std::string& name, std::span<const std::uint64_t> values) const;
    bool has_attribute(const std::string& name) const;
    double number_attribute(const std::string& name) const;
    std::uint64_t integer_attribute(const std::string& name) const;
    std::vector<double> numbers_attribute(const std::string& name) const;
    std::string text_attribute(const std::string& name) const;

    // All datasets below, depth first, in order of name; linked ones too, unless their file is not there.
    std::vector<DatasetInfo> datasets() const;
    DatasetInfo dataset(const std::string& name) const;

    std::int64_t id() const { return id_.get(); }
    const std::string& file() const { return file_; }
    const std::string& path() const { return path_; }  // "/bodies"

  private:
    Hdf5Id id_;
    std::string file_, path_;
};

// Every dataset of numbers is written by this function.
void write_rows(const Hdf5Group& group, const std::string& name, const Rows& rows, const Meaning& meaning,
                const Layout& layout = {});
// Appends to a dataset that was written extendible / keeps the first `count` rows of it.
void append_rows(const Hdf5Group& group, const std::string& name, const Rows& rows);
void cut_rows(const Hdf5Group& group, const std::string& name, std::size_t count);
// A mark on a dataset, beside unit and description.
void mark_dataset(const Hdf5Group& group, const std::string& name, const std::string& key, std::string_view value);
bool dataset_has_mark(const Hdf5Group& group, const std::string& name, const std::string& key);

void write_text(const Hdf5Group& group, const std::string& name, std::string_view text, std::string_view description);
void write_texts(const Hdf5Group& group, const std::string& name, const std::vector<std::string>& texts,
                 std::string_view description);
std::string read_text(const Hdf5Group& group, const std::string& name);
std::vector<std::string> read_texts(const Hdf5Group& group, const std::string& name);

// Reads a whole dataset into `out` (room for all its elements); HDF5 converts to `type` if the file has another.
void read_elements(const Hdf5Group& group, const std::string& name, ElementType type, void* out);
// `count` rows from row `begin` on.
void read_some_rows(const Hdf5Group& group, const std::string& name, ElementType type, std::uint64_t begin,
                    std::uint64_t count, void* out);
std::vector<double> read_numbers(const Hdf5Group& group, const std::string& name);

class Hdf5File {
  public:
    // An old file of this name is replaced. The first `user_block` bytes (0, or a power of 2 from 512) are left free.
    static Hdf5File create(const std::string& path, std::size_t user_block = 0);
    static Hdf5File open(const std::string& path);  // for reading
    static Hdf5File open_writable(const std::string& path);

    const Hdf5Group& root() const { return root_; }
    // Brings everything to the operating system, closes, and throws if anything could not be written, now or earlier;
    // the destructor closes without saying what went wrong.
    void close();

  private:
    Hdf5File(Hdf5Id id, std::string path);
    std::string path_;
    Hdf5Id id_;
    Hdf5Group root_;
};

// Root attributes `format` and `format_version` [1, 0], and the test of them when a file is read.
inline constexpr std::uint64_t kFormatMajor = 1, kFormatMinor = 0;
void write_format(const Hdf5Group& root, std::string_view format);
void check_format(const Hdf5Group& root, std::string_view format);

}  // namespace scree::io
