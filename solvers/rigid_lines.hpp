// The hot data of a body of any shape: velocities, which a sweep writes, in the first half of the line; the inverse
// inertia in world axes, which it only reads, in the second.   u = (v_a + w_a x r_a) - (v_b + w_b x r_b)
#pragma once

#include "core/aligned_vector.hpp"
#include "solvers/lines.hpp"

namespace scree::solvers {

template <class Real>
struct alignas(64) RigidLineOf {
    Real v[3];          // of the centre of mass [m/s]
    Real inverse_mass;  // [1/kg], 0 for what no impulse moves
    Real w[3];          // spin [rad/s]
    Real spare;
    Real j[6];  // inverse inertia tensor [1/(kg m2)]: xx, yy, zz, xy, xz, yz
    Real spare2[2];
};
using RigidLine = RigidLineOf<double>;
static_assert(sizeof(RigidLine) == 128 && sizeof(RigidLineOf<float>) == 64);

}  // namespace scree::solvers
