// For the files that call HDF5 itself: numbers of HDF5 turned into exceptions, and handles made from them.
#pragma once

#include <hdf5.h>

#include <string>
#include <vector>

#include "io/hdf5/hdf5_file.hpp"

namespace scree::io {

// Throws IoError: "file: what: HDF5's own words".
[[noreturn]] void throw_hdf5_error(const std::string& file, const std::string& what);

// The library must not print on its own; called before the first use.
void silence_hdf5();

inline void require(herr_t result, const std::string& file, const std::string& what) {
    if (result < 0) throw_hdf5_error(file, what);
}
inline Hdf5Id owned(hid_t id, Hdf5Id::Closer closer, const std::string& file, const std::string& what) {
    if (id < 0) throw_hdf5_error(file, what);
    return {id, closer};
}

std::string about(const std::string& name, const char* what);  // "dataset 'name' cannot be read"
Hdf5Id create_dataset(const Hdf5Group& group, const std::string& name, hid_t type, hid_t space, hid_t creation);
Hdf5Id open_dataset(const Hdf5Group& group, const std::string& name);
std::vector<hsize_t> extent(const Hdf5Id& dataset, const std::string& name, const std::string& file);
std::vector<hsize_t> dimensions(const Rows& rows);
Hdf5Id creation_list(const Rows& rows, const Layout& layout, const std::string& file);
void put_meaning(const Hdf5Id& dataset, const Meaning& meaning, const std::string& file);

hid_t memory_type(ElementType type);
hid_t file_type(ElementType type);
Hdf5Id utf8_type(std::size_t length, const std::string& file);  // fixed length, at least 1; 0: variable length
void put_text_attribute(hid_t object, const std::string& name, std::string_view value, const std::string& file);
std::string get_text_attribute(hid_t object, const std::string& name, const std::string& file);

}  // namespace scree::io
