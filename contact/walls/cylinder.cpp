// Cylinders.
//   inside, infinite:  one-sided: nothing gets out
//   inside, finite:    a thin shell with open ends (shell.cpp)
//   outside:           a solid pillar, with flat ends if it is finite
// Features inside: 0 nearest, 1 and 2 a third of a turn on. Outside: 0 the side, 1 the base's end, 2 the other end, 3
// and 4 their edges.
#include "contact/walls/shapes.hpp"

namespace scree::contact::detail {
namespace {

void infinite_inside(const CylinderWall& cylinder, const Probe& probe, WallContacts& out) {
    const AxialFrame at(probe.centre, cylinder.base, cylinder.axis);
    if (cylinder.radius - at.distance - probe.radius > probe.margin) return;
    const Vec3 outward = at.outward(cylinder.axis);
    for (std::uint32_t k = 0; k < 3; ++k) {
        const double gap = cylinder.radius - kThirds[k].cosine * at.distance - probe.radius;
        if (gap <= probe.margin) out.add(-kThirds[k].of(outward, cylinder.axis), gap, k);
    }
}

void pillar(const CylinderWall& cylinder, const Probe& probe, WallContacts& out) {
    const AxialFrame at(probe.centre, cylinder.base, cylinder.axis);
    const bool infinite = std::isinf(cylinder.length);
    const double beside = at.distance - cylinder.radius;  // each is positive on the outside
    const double below = infinite ? -kForever : -at.height;
    const double above = infinite ? -kForever : at.height - cylinder.length;
    const double beyond = std::max(below, above);
    const Vec3 end_normal = above >= below ? cylinder.axis : Vec3(-cylinder.axis);
    const std::uint32_t end = above >= below ? 2 : 1;
    if (std::max(beside, beyond) - probe.radius > probe.margin) return;
    const Vec3 outward = at.outward(cylinder.axis);
    if (beside > 0.0 && beyond > 0.0) {
        add_point(beside * outward + beyond * end_normal, outward, probe, end + 2, out);
        return;
    }
    const bool at_side = beside >= beyond;  // the only positive one, or the less deep
    const double gap = (at_side ? beside : beyond) - probe.radius;
    out.add(at_side ? outward : end_normal, gap, at_side ? 0 : end);
}

}  // namespace

void cylinder_contacts(const CylinderWall& cylinder, const Probe& probe, WallContacts& out) {
    if (!cylinder.inside) return pillar(cylinder, probe, out);
    if (std::isinf(cylinder.length)) return infinite_inside(cylinder, probe, out);
    const double radius = cylinder.radius;
    shell_contacts({cylinder.base, cylinder.axis, radius, radius, cylinder.length, true}, probe, out);
}

}  // namespace scree::contact::detail
