// Datasets of numbers: written, appended to, cut.
#include <algorithm>

#include "core/errors.hpp"
#include "io/hdf5/hdf5_checks.hpp"

namespace scree::io {

namespace {

// Chunks of arrays that grow by rows are small.
constexpr std::size_t kGrowingChunkBytes = 8 * 1024, kGrowingChunkRows = 16;

template <class T>
Rows view(std::span<const T> values, ElementType type) {
    return {values.data(), type, values.size(), {}};
}

}  // namespace

std::string about(const std::string& name, const char* what) {
    return "dataset '" + name + "' " + what;
}

Hdf5Id create_dataset(const Hdf5Group& group, const std::string& name, hid_t type, hid_t space, hid_t creation) {
    const std::string what = about(name, "cannot be written");
    const Hdf5Id links = owned(H5Pcreate(H5P_LINK_CREATE), H5Pclose, group.file(), what);
    require(H5Pset_create_intermediate_group(links.get(), 1), group.file(), what);
    return owned(H5Dcreate2(group.id(), name.c_str(), type, space, links.get(), creation, H5P_DEFAULT), H5Dclose,
                 group.file(), what);
}

Hdf5Id open_dataset(const Hdf5Group& group, const std::string& name) {
    const std::string where = group.path() == "/" ? "" : " in '" + group.path() + "'";
    return owned(H5Dopen2(group.id(), name.c_str(), H5P_DEFAULT), H5Dclose, group.file(),
                 "has no dataset '" + name + "'" + where);
}

std::vector<hsize_t> extent(const Hdf5Id& dataset, const std::string& name, const std::string& file) {
    const std::string what = about(name, "cannot be read");
    const Hdf5Id space = owned(H5Dget_space(dataset.get()), H5Sclose, file, what);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank < 0) throw_hdf5_error(file, what);
    std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
    require(H5Sget_simple_extent_dims(space.get(), dims.data(), nullptr), file, what);
    return dims;
}

hid_t memory_type(ElementType type) {
    switch (type) {
        case ElementType::f64:
            return H5T_NATIVE_DOUBLE;
        case ElementType::f32:
            return H5T_NATIVE_FLOAT;
        case ElementType::i64:
            return H5T_NATIVE_INT64;
        case ElementType::u64:
            return H5T_NATIVE_UINT64;
        case ElementType::i32:
            return H5T_NATIVE_INT32;
        case ElementType::u32:
            return H5T_NATIVE_UINT32;
        case ElementType::u16:
            return H5T_NATIVE_UINT16;
        case ElementType::u8:
            return H5T_NATIVE_UINT8;
    }
    throw InternalError("an element type without a memory type");
}

hid_t file_type(ElementType type) {
    switch (type) {
        case ElementType::f64:
            return H5T_IEEE_F64LE;
        case ElementType::f32:
            return H5T_IEEE_F32LE;
        case ElementType::i64:
            return H5T_STD_I64LE;
        case ElementType::u64:
            return H5T_STD_U64LE;
        case ElementType::i32:
            return H5T_STD_I32LE;
        case ElementType::u32:
            return H5T_STD_U32LE;
        case ElementType::u16:
            return H5T_STD_U16LE;
        case ElementType::u8:
            return H5T_STD_U8LE;
    }
    throw InternalError("an element type without a file type");
}

std::vector<hsize_t> dimensions(const Rows& rows) {
    std::vector<hsize_t> dims = {rows.count};
    dims.insert(dims.end(), rows.shape.begin(), rows.shape.end());
    return dims;
}

Hdf5Id creation_list(const Rows& rows, const Layout& layout, const std::string& file) {
    const std::string what = "HDF5 cannot be used";
    Hdf5Id list = owned(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, file, what);
    const bool chunked = layout.extendible || (layout.gzip > 0 && rows.elements() > 0);
    if (!chunked) return list;
    const std::size_t row_bytes = std::max<std::size_t>(1, rows.row_bytes());
    std::size_t chunk_rows = layout.extendible ? std::max(kGrowingChunkRows, kGrowingChunkBytes / row_bytes)
                                               : std::min(layout.chunk_rows, rows.count);
    std::vector<hsize_t> chunk = dimensions(rows);
    chunk[0] = chunk_rows;
    require(H5Pset_chunk(list.get(), static_cast<int>(chunk.size()), chunk.data()), file, what);
    if (layout.gzip > 0) {
        require(H5Pset_shuffle(list.get()), file, what);
        require(H5Pset_deflate(list.get(), static_cast<unsigned>(layout.gzip)), file, what);
    }
    return list;
}

void put_meaning(const Hdf5Id& dataset, const Meaning& meaning, const std::string& file) {
    put_text_attribute(dataset.get(), "unit", meaning.unit, file);
    put_text_attribute(dataset.get(), "description", meaning.description, file);
    if (!meaning.frame.empty()) put_text_attribute(dataset.get(), "frame", meaning.frame, file);
}

std::size_t Rows::elements() const {
    std::size_t n = count;
    for (std::size_t side : shape) n *= side;
    return n;
}

std::size_t Rows::row_bytes() const {
    Rows one = *this;
    one.count = 1;
    return one.elements() * H5Tget_size(memory_type(type));
}

Rows rows_of(std::span<const double> values) {
    return view(values, ElementType::f64);
}
Rows rows_of(std::span<const float> values) {
    return view(values, ElementType::f32);
}
Rows rows_of(std::span<const std::int64_t> values) {
    return view(values, ElementType::i64);
}
Rows rows_of(std::span<const std::uint64_t> values) {
    return view(values, ElementType::u64);
}
Rows rows_of(std::span<const std::int32_t> values) {
    return view(values, ElementType::i32);
}
Rows rows_of(std::span<const std::uint32_t> values) {
    return view(values, ElementType::u32);
}
Rows rows_of(std::span<const std::uint16_t> values) {
    return view(values, ElementType::u16);
}
Rows rows_of(std::span<const std::uint8_t> values) {
    return view(values, ElementType::u8);
}
Rows rows_of(std::span<const Vec3> values) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    Rows rows = view(values, ElementType::f64);
    rows.shape = {3};
    return rows;
}

void write_rows(const Hdf5Group& group, const std::string& name, const Rows& rows, const Meaning& meaning,
                const Layout& layout) {
    const std::string& file = group.file();
    const std::string what = about(name, "cannot be written");
    const std::vector<hsize_t> dims = dimensions(rows);
    std::vector<hsize_t> largest = dims;
    if (layout.extendible) largest[0] = H5S_UNLIMITED;
    const int rank = static_cast<int>(dims.size());
    const Hdf5Id space = owned(H5Screate_simple(rank, dims.data(), largest.data()), H5Sclose, file, what);
    const Hdf5Id creation = creation_list(rows, layout, file);
    const Hdf5Id dataset = create_dataset(group, name, file_type(rows.type), space.get(), creation.get());
    if (rows.elements() > 0) {
        require(H5Dwrite(dataset.get(), memory_type(rows.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data), file, what);
    }
    put_meaning(dataset, meaning, file);
}

void append_rows(const Hdf5Group& group, const std::string& name, const Rows& rows) {
    const std::string what = about(name, "cannot be appended to");
    const Hdf5Id dataset = open_dataset(group, name);
    std::vector<hsize_t> dims = extent(dataset, name, group.file());
    std::vector<hsize_t> start(dims.size(), 0);
    const std::vector<hsize_t> added = dimensions(rows);
    if (added.size() != dims.size() || !std::equal(dims.begin() + 1, dims.end(), added.begin() + 1)) {
        throw IoError(group.file() + ": " + what + ": its rows have another shape");
    }
    if (rows.count == 0) return;
    start[0] = dims[0];
    dims[0] += rows.count;
    require(H5Dset_extent(dataset.get(), dims.data()), group.file(), what);
    const int rank = static_cast<int>(dims.size());
    const Hdf5Id memory = owned(H5Screate_simple(rank, added.data(), nullptr), H5Sclose, group.file(), what);
    const Hdf5Id target = owned(H5Dget_space(dataset.get()), H5Sclose, group.file(), what);
    require(H5Sselect_hyperslab(target.get(), H5S_SELECT_SET, start.data(), nullptr, added.data(), nullptr),
            group.file(), what);
    require(H5Dwrite(dataset.get(), memory_type(rows.type), memory.get(), target.get(), H5P_DEFAULT, rows.data),
            group.file(), what);
}

void cut_rows(const Hdf5Group& group, const std::string& name, std::size_t count) {
    const std::string what = about(name, "cannot be shortened");
    const Hdf5Id dataset = open_dataset(group, name);
    std::vector<hsize_t> dims = extent(dataset, name, group.file());
    if (dims.empty() || dims[0] < count)
        throw IoError(group.file() + ": " + what + ": it has fewer rows than asked for");
    dims[0] = count;
    require(H5Dset_extent(dataset.get(), dims.data()), group.file(), what);
}

void mark_dataset(const Hdf5Group& group, const std::string& name, const std::string& key, std::string_view value) {
    put_text_attribute(open_dataset(group, name).get(), key, value, group.file());
}

bool dataset_has_mark(const Hdf5Group& group, const std::string& name, const std::string& key) {
    return H5Aexists(open_dataset(group, name).get(), key.c_str()) > 0;
}

}  // namespace scree::io
