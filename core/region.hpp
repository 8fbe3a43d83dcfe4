// Parts of space that a scenario names: where bodies are made, counted, taken away. Plain data and membership.
#pragma once

#include <limits>
#include <variant>

#include "core/vec.hpp"

namespace scree {

struct BoxRegion {
    Vec3 lower, upper;  // [m]
};
struct CylinderRegion {
    Vec3 base;              // centre of the lower end [m]
    Vec3 axis;              // unit vector
    double radius, length;  // [m]
};
struct SphereRegion {
    Vec3 centre;
    double radius;
};
// { x : (x - point) . normal <= 0 }: the side that the normal points away from
struct HalfSpaceRegion {
    Vec3 point, normal;
};
using Region = std::variant<BoxRegion, CylinderRegion, SphereRegion, HalfSpaceRegion>;

bool contains(const Region& region, const Vec3& x);
// Volume [m3]; infinite for a half-space.
double volume(const Region& region);
// Axis-aligned bounds; infinite for a half-space.
BoxRegion bounds(const Region& region);
// Moves a region by `shift`.
Region translated(const Region& region, const Vec3& shift);

}  // namespace scree
