// 64 bits over ids, positions, orientations (if any), velocities and spins (if any). Equal states have equal hashes,
// however the bodies lie on ranks; it is what runs are compared by. Each body gives one mixed word of its id and the
// bytes of its doubles (one changed bit shows); the words are added modulo 2^64, which no order can change.
#pragma once

#include <cstdint>

#include "core/bodies.hpp"
#include "core/parallel/communicator.hpp"

namespace scree {

// Of all ranks' bodies, on every rank (collective). Ghosts do not count.
std::uint64_t state_hash(const Bodies& bodies, const Communicator& ranks = Communicator::self());

}  // namespace scree
