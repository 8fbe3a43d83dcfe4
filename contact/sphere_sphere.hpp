// Two spheres: gap = |x_a - x_b| - (R_a + R_b) [m], normal = (x_a - x_b) / |x_a - x_b| (contact frame: from b to a).
#pragma once

#include "core/vec.hpp"

namespace scree::contact {

struct SphereGap {
    double gap;   // [m]
    Vec3 normal;  // unit
};

// Coincident centres have no direction: the way they came apart or would, else z.
inline SphereGap sphere_sphere(const Vec3& xa, const Vec3& xb, double radii, const Vec3& relative_velocity) {
    const Vec3 d = xa - xb;
    const double distance = d.norm();
    if (distance > 0.0) return {distance - radii, d / distance};
    const double speed = relative_velocity.norm();
    return {-radii, speed > 0.0 ? Vec3(-relative_velocity / speed) : Vec3::UnitZ()};
}

}  // namespace scree::contact
