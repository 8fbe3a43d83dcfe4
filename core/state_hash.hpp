// 64 bits over ids, positions, orientations (if any), velocities and spins (if any), in order of id. Equal states have
// equal hashes; it is what a resumed run is compared by. Bytes of the doubles are hashed, so one changed bit shows.
#pragma once

#include <cstdint>

#include "core/bodies.hpp"

namespace scree {

std::uint64_t state_hash(const Bodies& bodies);

}  // namespace scree
