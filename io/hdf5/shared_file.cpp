#include "io/hdf5/shared_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>

#include "io/atomic_file.hpp"
#include "io/hdf5/file_driver.hpp"
#include "io/hdf5/hdf5_checks.hpp"
#include "io/hdf5/packed_rows.hpp"
#include "io/hdf5/whole_chunks.hpp"

namespace scree::io {

static_assert(std::endian::native == std::endian::little, "rows go to the file as they are in memory");

namespace {

// What rank 0 must know of a chunk to give it a place.
struct ChunkSize {
    std::uint64_t number;
    std::uint64_t bytes;
    std::uint64_t filters_left_out;
};

template <class T>
std::vector<std::byte> to_bytes(const std::vector<T>& values) {
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}
template <class T>
std::vector<T> from_bytes(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

Rows of_all(Rows rows, std::uint64_t total) {
    rows.count = total;
    return rows;
}

// A dataset without its numbers.
Hdf5Id create_empty(const Hdf5Group& root, const std::string& name, const Rows& rows, const Meaning& meaning,
                    const Hdf5Id& creation) {
    const std::string what = about(name, "cannot be written");
    const std::vector<hsize_t> dims = dimensions(rows);
    const Hdf5Id space =
        owned(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose, root.file(), what);
    Hdf5Id dataset = create_dataset(root, name, file_type(rows.type), space.get(), creation.get());
    put_meaning(dataset, meaning, root.file());
    return dataset;
}

// Returns where its numbers begin; 0 if it has none.
std::uint64_t place_plain(const Hdf5Group& root, const std::string& name, const Rows& rows, const Meaning& meaning) {
    const std::string what = about(name, "cannot be written");
    const Hdf5Id creation = creation_list(rows, {}, root.file());
    require(H5Pset_alloc_time(creation.get(), H5D_ALLOC_TIME_EARLY), root.file(), what);
    require(H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER), root.file(), what);
    const Hdf5Id dataset = create_empty(root, name, rows, meaning, creation);
    if (rows.elements() == 0) return 0;
    const haddr_t place = H5Dget_offset(dataset.get());
    if (place == HADDR_UNDEF) throw_hdf5_error(root.file(), what);
    return place;
}

// Gives each chunk its place.
std::vector<std::uint64_t> place_chunks(const Hdf5Id& dataset, const std::vector<ChunkSize>& sizes,
                                        std::size_t chunk_rows, const Rows& rows, const std::string& name,
                                        const std::string& file) {
    std::vector<std::uint64_t> places;
    std::vector<hsize_t> start(1 + rows.shape.size(), 0);
    std::vector<std::byte> anything;
    for (const ChunkSize& size : sizes) {
        start[0] = size.number * chunk_rows;
        anything.resize(std::max<std::size_t>(anything.size(), size.bytes));
        const OnlyPlaces placing;
        require(H5Dwrite_chunk(dataset.get(), H5P_DEFAULT, static_cast<std::uint32_t>(size.filters_left_out),
                               start.data(), size.bytes, anything.data()),
                file, about(name, "cannot be written"));
        places.push_back(placing.last());
    }
    return places;
}

}  // namespace

SharedFile::SharedFile(std::string path, std::size_t user_block, const Communicator& ranks)
    : path_(std::move(path)), ranks_(ranks) {
    if (ranks_.alone()) {
        file_.emplace(Hdf5File::create(path_, user_block));
        return;
    }
    scree::by_root(ranks_, [&] { file_.emplace(Hdf5File::create(path_, user_block)); });
    fault_ = fault_of([&] {
        descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) throw_system_error(path_, "cannot be opened", errno);
    });
}

SharedFile::~SharedFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void SharedFile::by_root(const std::function<void(const Hdf5Group& root)>& write) {
    if (ranks_.alone()) {
        write(file_->root());
    } else if (ranks_.root() && fault_.empty()) {
        fault_ = fault_of([&] { write(file_->root()); });
    }
}

SharedFile::Extent SharedFile::rows(const std::string& name, const Rows& rows, const Meaning& meaning,
                                    const Layout& layout) {
    const Extent extent{ranks_.sum_before(rows.count), ranks_.sum(rows.count)};
    if (ranks_.alone()) {
        write_rows(file_->root(), name, rows, meaning, layout);
    } else if (layout.gzip > 0 && of_all(rows, extent.total).elements() > 0) {
        packed_rows(name, rows, extent, meaning, layout);
    } else {
        plain_rows(name, rows, extent, meaning);
    }
    return extent;
}

void SharedFile::plain_rows(const std::string& name, const Rows& rows, const Extent& extent, const Meaning& meaning) {
    std::uint64_t place = 0;
    by_root([&](const Hdf5Group& root) { place = place_plain(root, name, of_all(rows, extent.total), meaning); });
    place = ranks_.max(place);  // rank 0's
    if (place > 0) write_at(place + extent.begin * rows.row_bytes(), rows.data, rows.count * rows.row_bytes());
}

// The ranks tell rank 0 how large their chunks are, it answers where they go.
void SharedFile::packed_rows(const std::string& name, const Rows& any_rows, const Extent& extent,
                             const Meaning& meaning, const Layout& layout) {
    const std::size_t chunk_rows = std::min<std::size_t>(layout.chunk_rows, extent.total);
    const WholeChunks whole(any_rows, extent.begin, chunk_rows, ranks_);
    const Rows& rows = whole.rows();
    std::vector<PackedChunk> chunks;
    if (fault_.empty()) fault_ = fault_of([&] { chunks = pack_rows(rows, chunk_rows, layout, path_); });
    std::vector<Communicator::Message> messages;
    if (!chunks.empty()) {
        std::vector<ChunkSize> sizes;
        for (const PackedChunk& chunk : chunks)
            sizes.push_back({whole.first_chunk() + sizes.size(), chunk.bytes.size(), chunk.filters_left_out});
        messages.push_back({0, to_bytes(sizes)});
    }
    messages = ranks_.exchange(messages);
    by_root([&](const Hdf5Group& root) {
        const Rows all = of_all(rows, extent.total);
        const Hdf5Id dataset = create_empty(root, name, all, meaning, creation_list(all, layout, path_));
        for (Communicator::Message& message : messages) {
            const auto sizes = from_bytes<ChunkSize>(message.bytes);
            message.bytes = to_bytes(place_chunks(dataset, sizes, chunk_rows, all, name, path_));
        }
    });
    if (ranks_.root() && !fault_.empty()) messages.clear();
    messages = ranks_.exchange(messages);
    if (messages.empty()) return;
    const auto places = from_bytes<std::uint64_t>(messages.front().bytes);
    for (std::size_t k = 0; k < places.size(); ++k) write_at(places[k], chunks[k].bytes.data(), chunks[k].bytes.size());
}

void SharedFile::write_at(std::uint64_t place, const void* data, std::size_t bytes) {
    const auto* from = static_cast<const char*>(data);
    while (bytes > 0 && fault_.empty()) {
        const ssize_t n = ::pwrite(descriptor_, from, bytes, static_cast<off_t>(place));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) {
            fault_ = fault_of([&] { throw_system_error(path_, "cannot be written", errno); });
            return;
        }
        from += n, place += static_cast<std::uint64_t>(n), bytes -= static_cast<std::size_t>(n);
    }
}

void SharedFile::close() {
    if (ranks_.alone()) {
        file_->close();
        return;
    }
    if (fault_.empty() && ::fsync(descriptor_) != 0) {
        fault_ = fault_of([&] { throw_system_error(path_, "cannot be brought to the disk", errno); });
    }
    by_root([&](const Hdf5Group&) { file_->close(); });
    agree_on_fault(fault_, ranks_);
}

}  // namespace scree::io
