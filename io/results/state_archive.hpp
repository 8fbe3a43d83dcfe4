// Every member of State as datasets, written and read by the same list (state_archive.cpp), so that the two cannot
// differ.
#pragma once

#include <cstdint>

#include "core/parallel/communicator.hpp"
#include "core/state.hpp"

namespace scree::io {

class Hdf5Group;
class SharedFile;

// Both give a 64-bit checksum over the names, sizes and bytes of all numbers. Any one changed bit changes it; how many
// ranks wrote or read does not.

// Collective. `bodies` and `warm_start`: this rank's rows of them, in place of those in `state`.
std::uint64_t write_state(SharedFile& file, const State& state, const Bodies& bodies, const WarmStart& warm_start);
// This rank's slice of the bodies, the impulses of contacts whose body a it has, and the rest. Not collective: the sum
// of the ranks' values is the checksum.
std::uint64_t read_state(const Hdf5Group& root, State& state, const Communicator& ranks);

}  // namespace scree::io
