// The hot data of a body: all that a sweep reads and writes of it, in one aligned line.
// Spin is held as w = R omega [m/s], so that no kernel needs a radius:  u = v_a - v_b - (w_a + w_b) x n.
#pragma once

#include "core/aligned_vector.hpp"

namespace scree::solvers {

template <class Real>
struct alignas(8 * sizeof(Real)) SpinningLineOf {  // scenes with friction
    Real v[3];                                     // [m/s]
    Real inverse_mass;                             // [1/kg], 0 for what no impulse moves
    Real w[3];                                     // [m/s]
    Real inverse_inertia;                          // R^2 / I [1/kg]
};
using SpinningLine = SpinningLineOf<double>;
static_assert(sizeof(SpinningLine) == 64);

template <class Real>
struct alignas(4 * sizeof(Real)) SlidingLineOf {  // scenes without friction; displacements of the position correction
    Real v[3];                                    // [m/s] or [m]
    Real inverse_mass;                            // [1/kg]
};
using SlidingLine = SlidingLineOf<double>;
static_assert(sizeof(SlidingLine) == 32);

// Line 0 is the ground: at rest, immovable; it also fills the unused lanes of a batch. Bodies follow, then one line for
// each contact with a moving wall.
inline constexpr std::uint32_t kGround = 0;

}  // namespace scree::solvers
