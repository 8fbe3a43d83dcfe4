// Every member of State as datasets, written and read by the same list (state_archive.cpp), so that the two cannot
// differ.
#pragma once

#include <cstdint>

#include "core/state.hpp"

namespace scree::io {

class Hdf5Group;

// Both return a 64-bit checksum over the names, sizes and bytes of all numbers. Any one changed bit changes it.
std::uint64_t write_state(const Hdf5Group& root, const State& state);
std::uint64_t read_state(const Hdf5Group& root, State& state);

}  // namespace scree::io
