// Rotations without a preferred direction, another one for each seed.
#pragma once

#include "core/random.hpp"
#include "core/vec.hpp"

namespace scree::testing {

inline Quat some_rotation(std::uint64_t seed) {
    Random random(seed, 2, 0);
    Eigen::Vector4d q;
    for (int k = 0; k < 4; ++k) q[k] = random.normal();
    return Quat(q).normalized();
}

}  // namespace scree::testing
