// The hot data of a body: all that a sweep reads and writes of it, in one aligned line.
// Spin is held as w = R omega [m/s], so that no kernel needs a radius:  u = v_a - v_b - (w_a + w_b) x n.
#pragma once

#include "core/aligned_vector.hpp"

namespace scree::solvers {

struct alignas(64) SpinningLine {  // 64 bytes: scenes with friction
    double v[3];                   // [m/s]
    double inverse_mass;           // [1/kg], 0 for what no impulse moves
    double w[3];                   // [m/s]
    double inverse_inertia;        // R^2 / I [1/kg]
};
static_assert(sizeof(SpinningLine) == 64);

struct alignas(32) SlidingLine {  // 32 bytes: scenes without friction; displacements of the position correction
    double v[3];                  // [m/s] or [m]
    double inverse_mass;          // [1/kg]
};
static_assert(sizeof(SlidingLine) == 32);

// Line 0 is the ground: at rest, immovable; it also fills the unused lanes of a batch. Bodies follow, then one line for
// each contact with a moving wall.
inline constexpr std::uint32_t kGround = 0;

}  // namespace scree::solvers
