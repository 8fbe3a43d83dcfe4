// A seal in the first 512 bytes of a file (HDF5's user block: its readers skip it): a line of text with a checksum of
// all that follows. It is tested before HDF5 sees the file, because HDF5 1.10 can crash on a damaged one.
//
// The checksum is a sum over stripes of 64 MB, modulo 2^64, each mixed with its number: ranks read the stripes in turn,
// and the seal does not depend on how many they are.
#pragma once

#include <cstddef>
#include <string>

#include "core/parallel/communicator.hpp"

namespace scree::io {

inline constexpr std::size_t kSealBytes = 512;

// Collective. Writes the seal into a complete file that has room for it.
void seal(const std::string& path, const Communicator& ranks = Communicator::self());
// Collective. Throws IoError if there is no seal or it does not fit.
void check_seal(const std::string& path, const Communicator& ranks = Communicator::self());
bool has_seal(const std::string& path);

}  // namespace scree::io
