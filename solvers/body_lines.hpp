// Bodies into lines and back, for each kind of line.
#pragma once

#include "core/bodies.hpp"
#include "solvers/lines.hpp"
#include "solvers/rigid_lines.hpp"
#include "solvers/rotation.hpp"

namespace scree::solvers {

template <class Line>
void set_velocity(Line& line, const Vec3& v, double inverse_mass) {
    for (int k = 0; k < 3; ++k) line.v[k] = v[k];
    line.inverse_mass = inverse_mass;
}

// What the line holds of the spin of body i: R w [m/s] of spheres.
inline Vec3 spin_in_line(const SpinningLine&, const Bodies& bodies, std::size_t i) {
    return bodies.radius[i] * bodies.spin[i];
}
inline Vec3 spin_in_line(const RigidLine&, const Bodies& bodies, std::size_t i) {
    return bodies.spin[i];
}
inline Vec3 spin_of_line(const SpinningLine& line, const Bodies& bodies, std::size_t i) {
    return Vec3(line.w[0], line.w[1], line.w[2]) / bodies.radius[i];
}
inline Vec3 spin_of_line(const RigidLine& line, const Bodies&, std::size_t) {
    return {line.w[0], line.w[1], line.w[2]};
}

// Velocities of body i, `v` the linear one, and its inverse inertias.
inline void set_body(SlidingLine& line, const Bodies& bodies, std::size_t i, const Vec3& v) {
    set_velocity(line, v, 1.0 / bodies.mass[i]);
}
inline void set_body(SpinningLine& line, const Bodies& bodies, std::size_t i, const Vec3& v) {
    const double inverse_mass = 1.0 / bodies.mass[i];
    set_velocity(line, v, inverse_mass);
    const Vec3 w = spin_in_line(line, bodies, i);
    for (int k = 0; k < 3; ++k) line.w[k] = w[k];
    line.inverse_inertia = inverse_mass / Bodies::kSphereInertia;
}
inline void set_body(RigidLine& line, const Bodies& bodies, std::size_t i, const Vec3& v) {
    line = RigidLine{};
    set_velocity(line, v, 1.0 / bodies.mass[i]);
    for (int k = 0; k < 3; ++k) line.w[k] = bodies.spin[i][k];
    const Mat3 j = inverse_inertia(bodies.orientation[i], bodies.inertia[i]);
    const double tensor[6] = {j(0, 0), j(1, 1), j(2, 2), j(0, 1), j(0, 2), j(1, 2)};
    for (int k = 0; k < 6; ++k) line.j[k] = tensor[k];
}

}  // namespace scree::solvers
