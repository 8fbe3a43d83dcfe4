// Attributes of groups and datasets.
#include "core/errors.hpp"
#include "io/hdf5/hdf5_checks.hpp"

namespace scree::io {

namespace {

// Writes an attribute, in place of one of the same name.
void put_attribute(hid_t object, const std::string& name, hid_t file_type, hid_t type, std::size_t count, bool scalar,
                   const void* data, const std::string& file) {
    const std::string what = "attribute '" + name + "' cannot be written";
    if (H5Aexists(object, name.c_str()) > 0) require(H5Adelete(object, name.c_str()), file, what);
    const hsize_t dims[] = {count};
    const Hdf5Id space =
        owned(scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, dims, nullptr), H5Sclose, file, what);
    const Hdf5Id attribute =
        owned(H5Acreate2(object, name.c_str(), file_type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, file, what);
    require(H5Awrite(attribute.get(), type, data), file, what);
}

Hdf5Id open_attribute(hid_t object, const std::string& name, const std::string& file) {
    return owned(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, file, "has no attribute '" + name + "'");
}

}  // namespace

Hdf5Id utf8_type(std::size_t length, const std::string& file) {
    const std::string what = "a text type cannot be made";
    Hdf5Id type = owned(H5Tcopy(H5T_C_S1), H5Tclose, file, what);
    require(H5Tset_size(type.get(), length == 0 ? H5T_VARIABLE : length), file, what);
    require(H5Tset_cset(type.get(), H5T_CSET_UTF8), file, what);
    if (length != 0) require(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), file, what);
    return type;
}

void put_text_attribute(hid_t object, const std::string& name, std::string_view value, const std::string& file) {
    const Hdf5Id type = utf8_type(0, file);
    const std::string text(value);
    const char* pointer = text.c_str();
    put_attribute(object, name, type.get(), type.get(), 1, true, &pointer, file);
}

std::string get_text_attribute(hid_t object, const std::string& name, const std::string& file) {
    const std::string what = "attribute '" + name + "' cannot be read";
    const Hdf5Id attribute = open_attribute(object, name, file);
    const Hdf5Id type = owned(H5Aget_type(attribute.get()), H5Tclose, file, what);
    if (H5Tget_class(type.get()) != H5T_STRING) throw IoError(file + ": attribute '" + name + "' is not a text");
    if (H5Tis_variable_str(type.get()) > 0) {
        const Hdf5Id variable = utf8_type(0, file);
        char* pointer = nullptr;
        require(H5Aread(attribute.get(), variable.get(), &pointer), file, what);
        const std::string text = pointer != nullptr ? pointer : "";
        H5free_memory(pointer);
        return text;
    }
    std::string text(H5Tget_size(type.get()), '\0');
    require(H5Aread(attribute.get(), type.get(), text.data()), file, what);
    return text.substr(0, text.find('\0'));
}

void Hdf5Group::attribute(const std::string& name, double value) const {
    put_attribute(id(), name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, true, &value, file_);
}
void Hdf5Group::attribute(const std::string& name, std::uint64_t value) const {
    put_attribute(id(), name, H5T_STD_U64LE, H5T_NATIVE_UINT64, 1, true, &value, file_);
}
void Hdf5Group::attribute(const std::string& name, std::string_view value) const {
    put_text_attribute(id(), name, value, file_);
}
void Hdf5Group::attribute(const std::string& name, std::span<const double> values) const {
    put_attribute(id(), name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.size(), false, values.data(), file_);
}
void Hdf5Group::attribute(const std::string& name, std::span<const std::uint64_t> values) const {
    put_attribute(id(), name, H5T_STD_U64LE, H5T_NATIVE_UINT64, values.size(), false, values.data(), file_);
}

bool Hdf5Group::has_attribute(const std::string& name) const {
    return H5Aexists(id(), name.c_str()) > 0;
}

std::vector<double> Hdf5Group::numbers_attribute(const std::string& name) const {
    const std::string what = "attribute '" + name + "' cannot be read";
    const Hdf5Id attribute = open_attribute(id(), name, file_);
    const Hdf5Id space = owned(H5Aget_space(attribute.get()), H5Sclose, file_, what);
    const hssize_t count = H5Sget_simple_extent_npoints(space.get());
    if (count < 0) throw_hdf5_error(file_, what);
    std::vector<double> values(static_cast<std::size_t>(count));
    require(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, values.data()), file_, what);
    return values;
}

double Hdf5Group::number_attribute(const std::string& name) const {
    const std::vector<double> values = numbers_attribute(name);
    if (values.size() != 1) throw IoError(file_ + ": attribute '" + name + "' is not one number");
    return values[0];
}

std::uint64_t Hdf5Group::integer_attribute(const std::string& name) const {
    if (numbers_attribute(name).size() != 1) throw IoError(file_ + ": attribute '" + name + "' is not one number");
    std::uint64_t value = 0;
    const Hdf5Id attribute = open_attribute(id(), name, file_);
    require(H5Aread(attribute.get(), H5T_NATIVE_UINT64, &value), file_, "attribute '" + name + "' cannot be read");
    return value;
}

std::string Hdf5Group::text_attribute(const std::string& name) const {
    return get_text_attribute(id(), name, file_);
}

}  // namespace scree::io
