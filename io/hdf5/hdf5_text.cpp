// Datasets of text, each of one fixed length, padded with zeros.
#include <algorithm>
#include <cstring>

#include "core/errors.hpp"
#include "io/hdf5/hdf5_checks.hpp"

namespace scree::io {

namespace {

void write_fixed(const Hdf5Group& group, const std::string& name, const std::vector<std::string>& texts, bool scalar,
                 std::string_view description) {
    const std::string what = about(name, "cannot be written");
    std::size_t length = 1;
    for (const std::string& text : texts) length = std::max(length, text.size());
    std::string packed(length * texts.size(), '\0');
    for (std::size_t i = 0; i < texts.size(); ++i) std::memcpy(&packed[i * length], texts[i].data(), texts[i].size());
    const Hdf5Id type = utf8_type(length, group.file());
    const hsize_t dims[] = {texts.size()};
    const Hdf5Id space =
        owned(scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, dims, nullptr), H5Sclose, group.file(), what);
    const Hdf5Id dataset = create_dataset(group, name, type.get(), space.get(), H5P_DEFAULT);
    if (!texts.empty()) {
        require(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, packed.data()), group.file(), what);
    }
    put_text_attribute(dataset.get(), "description", description, group.file());
}

}  // namespace

void write_text(const Hdf5Group& group, const std::string& name, std::string_view text, std::string_view description) {
    write_fixed(group, name, {std::string(text)}, true, description);
}

void write_texts(const Hdf5Group& group, const std::string& name, const std::vector<std::string>& texts,
                 std::string_view description) {
    write_fixed(group, name, texts, false, description);
}

std::vector<std::string> read_texts(const Hdf5Group& group, const std::string& name) {
    const std::string what = about(name, "cannot be read");
    const Hdf5Id dataset = open_dataset(group, name);
    const Hdf5Id type = owned(H5Dget_type(dataset.get()), H5Tclose, group.file(), what);
    if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0) {
        throw IoError(group.file() + ": " + about(name, "is not a text as Scree writes them"));
    }
    std::size_t count = 1;
    for (hsize_t side : extent(dataset, name, group.file())) count *= side;
    const std::size_t length = H5Tget_size(type.get());
    std::string packed(length * count, '\0');
    if (count > 0) {
        require(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, packed.data()), group.file(), what);
    }
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string text = packed.substr(i * length, length);
        texts.push_back(text.substr(0, text.find('\0')));
    }
    return texts;
}

std::string read_text(const Hdf5Group& group, const std::string& name) {
    return read_texts(group, name).at(0);
}

}  // namespace scree::io
