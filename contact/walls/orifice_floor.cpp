// An infinite thin floor with a round hole, two-sided. Beside the hole a sphere touches the face; over it, the rim at
// the nearest point and a third of a turn to either side (a sphere wider than the hole rests on it all round).
// Features: 0 the face or the nearest point of the rim, 1 and 2 the others.
#include "contact/walls/shapes.hpp"

namespace scree::contact::detail {

void orifice_floor_contacts(const OrificeFloor& floor, const Probe& probe, WallContacts& out) {
    const double height = (probe.centre - floor.centre).dot(floor.normal);
    if (std::abs(height) - probe.radius > probe.margin) return;  // most bodies
    const AxialFrame at(probe.centre, floor.centre, floor.normal);
    if (at.distance >= floor.hole_radius) {
        out.add(height < 0.0 ? Vec3(-floor.normal) : floor.normal, std::abs(height) - probe.radius, 0);
        return;
    }
    const Vec3 outward = at.outward(floor.normal);
    for (std::uint32_t k = 0; k < 3; ++k) {
        const Vec3 rim = floor.hole_radius * kThirds[k].of(outward, floor.normal);
        add_point(at.distance * outward - rim + height * floor.normal, floor.normal, probe, k, out);
    }
}

}  // namespace scree::contact::detail
