// An infinite thin floor with a rectangular hole, two-sided. Beside the hole a sphere touches the face; over it, every
// edge that is near enough, at the point nearest to the centre (a sphere wider than the slot rests on both long edges).
// Features: 0 the face, 1 and 2 the long edges, 3 and 4 the short ones.
#include "contact/walls/shapes.hpp"

namespace scree::contact::detail {

void slot_floor_contacts(const SlotFloor& floor, const Probe& probe, WallContacts& out) {
    const Vec3 relative = probe.centre - floor.centre;
    const double height = relative.dot(floor.normal);
    if (std::abs(height) - probe.radius > probe.margin) return;  // most bodies
    const Vec3 across = floor.normal.cross(floor.along);
    const double u = relative.dot(floor.along), v = relative.dot(across);
    const double half_length = 0.5 * floor.length, half_width = 0.5 * floor.width;
    if (std::abs(u) >= half_length || std::abs(v) >= half_width) {
        out.add(height < 0.0 ? Vec3(-floor.normal) : floor.normal, std::abs(height) - probe.radius, 0);
        return;
    }
    const Vec3 above = height * floor.normal;
    add_point((v + half_width) * across + above, floor.normal, probe, 1, out);
    add_point((v - half_width) * across + above, floor.normal, probe, 2, out);
    if (std::isinf(half_length)) return;
    add_point((u + half_length) * floor.along + above, floor.normal, probe, 3, out);
    add_point((u - half_length) * floor.along + above, floor.normal, probe, 4, out);
}

}  // namespace scree::contact::detail
