// What datasets there are, and their numbers.
#include "core/errors.hpp"
#include "io/hdf5/hdf5_checks.hpp"

namespace scree::io {

namespace {

// The kind that holds it.
ElementType element_type_of(hid_t type) {
    const std::size_t size = H5Tget_size(type);
    if (H5Tget_class(type) != H5T_INTEGER) return size > 4 ? ElementType::f64 : ElementType::f32;
    if (H5Tget_sign(type) == H5T_SGN_2) return size > 4 ? ElementType::i64 : ElementType::i32;
    if (size > 4) return ElementType::u64;
    return size > 2 ? ElementType::u32 : size > 1 ? ElementType::u16 : ElementType::u8;
}

}  // namespace

DatasetInfo Hdf5Group::dataset(const std::string& name) const {
    const Hdf5Id dataset = open_dataset(*this, name);
    DatasetInfo info;
    info.name = name;
    const std::vector<hsize_t> dims = extent(dataset, name, file_);
    info.shape.assign(dims.begin(), dims.end());
    const Hdf5Id type = owned(H5Dget_type(dataset.get()), H5Tclose, file_, about(name, "cannot be read"));
    info.text = H5Tget_class(type.get()) == H5T_STRING;
    if (!info.text) info.type = element_type_of(type.get());
    const auto text = [&](const char* key) {
        return H5Aexists(dataset.get(), key) > 0 ? get_text_attribute(dataset.get(), key, file_) : std::string();
    };
    info.unit = text("unit");
    info.description = text("description");
    return info;
}

void read_elements(const Hdf5Group& group, const std::string& name, ElementType type, void* out) {
    const Hdf5Id dataset = open_dataset(group, name);
    for (hsize_t side : extent(dataset, name, group.file())) {
        if (side == 0) return;
    }
    require(H5Dread(dataset.get(), memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, out), group.file(),
            about(name, "cannot be read"));
}

void read_some_rows(const Hdf5Group& group, const std::string& name, ElementType type, std::uint64_t begin,
                    std::uint64_t count, void* out) {
    if (count == 0) return;
    const std::string what = about(name, "cannot be read");
    const Hdf5Id dataset = open_dataset(group, name);
    std::vector<hsize_t> some = extent(dataset, name, group.file()), start(some.size(), 0);
    if (some.empty()) throw IoError(group.file() + ": " + about(name, "has no rows"));
    some[0] = count;
    start[0] = begin;
    const int rank = static_cast<int>(some.size());
    const Hdf5Id memory = owned(H5Screate_simple(rank, some.data(), nullptr), H5Sclose, group.file(), what);
    const Hdf5Id source = owned(H5Dget_space(dataset.get()), H5Sclose, group.file(), what);
    require(H5Sselect_hyperslab(source.get(), H5S_SELECT_SET, start.data(), nullptr, some.data(), nullptr),
            group.file(), what);
    require(H5Dread(dataset.get(), memory_type(type), memory.get(), source.get(), H5P_DEFAULT, out), group.file(),
            what);
}

std::vector<double> read_numbers(const Hdf5Group& group, const std::string& name) {
    const DatasetInfo info = group.dataset(name);
    std::size_t elements = 1;
    for (std::size_t side : info.shape) elements *= side;
    std::vector<double> values(elements);
    read_elements(group, name, ElementType::f64, values.data());
    return values;
}

}  // namespace scree::io
