// Free rotation of a rigid body over a time tau: the angular momentum L [N m s] is constant in the world, the
// orientation R follows
//   dR/dt = [w]x R,   w = R I^-1 R^T L,   I = diag(I_1, I_2, I_3) [kg m2], increasing
//
// by splitting the kinetic energy (McLachlan 1993; Dullweber, Leimkuhler and McLachlan 1997), with the sphere of the
// middle moment taken out of it:
//   L^2 / (2 I_2)                         the body turns about L at |L| / I_2: in the world, exact, commutes with all
//   l_1^2 / 2 (1/I_1 - 1/I_2),
//   l_3^2 / 2 (1/I_3 - 1/I_2),  l = R^T L the body turns about its own axis: exact
//   R+ = exp([L / I_2] tau) R  X(tau/2) Z(tau) X(tau/2)
// Each factor is a rotation that leaves L as it is: |L| is kept to round-off, the energy stays between L^2/2I_3 and
// L^2/2I_1 at any step and oscillates without a trend (symplectic, symmetric, order 2). Bodies with two equal moments
// (spheres, cubes, discs, needles) turn exactly.
#pragma once

#include "core/bodies.hpp"
#include "core/exact_sum.hpp"
#include "core/vec.hpp"

namespace scree::solvers {

// The orientation after `time` [s]; a unit quaternion.
Quat rotated_freely(const Quat& orientation, const Vec3& inertia, const Vec3& momentum, double time);

// R I R^T w [N m s] and R I^-1 R^T L [rad/s].
Vec3 angular_momentum(const Quat& orientation, const Vec3& inertia, const Vec3& spin);
Vec3 spin_of(const Quat& orientation, const Vec3& inertia, const Vec3& momentum);
// R I^-1 R^T [1/(kg m2)]; of a sphere exactly a multiple of 1.
Mat3 inverse_inertia(const Quat& orientation, const Vec3& inertia);

// exp([turn]x) q: a turn [rad] about an axis of the world.
Quat turned(const Quat& orientation, const Vec3& turn);

// Positions by `time` times the velocities; orientations and spins as above, each body by itself.
// `gain` [J]: adds the change of the kinetic energy of rotation of own bodies.
void move_freely(Bodies& bodies, double time, ExactSum& gain);

}  // namespace scree::solvers
