// Cones and shells with a straight profile: thin and two-sided, for their ends are open and bodies can get round them.
// In the plane through the axis and the centre the surface is the segment from (radius_base, 0) to (radius_end,
// length):
//   t = (radius_end - radius_base, length) / |.|   along it,      m = (-t_z, t_r)   its normal, towards the axis
//   s = (x - p0) . t                               foot,          d = (x - p0) . m  distance, positive on the inside
// 0 <= s <= |.|: the contact is with the surface, else with the rim at the nearer end (an apex, if its radius is 0).
// A sphere inside that fills the cone touches it all round, so from inside, and at the rims, the places a third of a
// turn to either side are reported as well: features 0, 1, 2.
#include "contact/walls/shapes.hpp"

namespace scree::contact::detail {
namespace {

struct Profile {
    double t_radial, t_axial, size;

    explicit Profile(const Shell& shell) {
        const double widening = shell.radius_end - shell.radius_base;
        size = length_of(Vec3(widening, 0.0, shell.length));
        t_radial = widening / size;
        t_axial = shell.length / size;
    }
    double foot(double from_base, double height) const { return from_base * t_radial + height * t_axial; }
    double depth(double from_base, double height) const { return height * t_radial - from_base * t_axial; }
};

}  // namespace

void shell_contacts(const Shell& shell, const Probe& probe, WallContacts& out) {
    const AxialFrame at(probe.centre, shell.base, shell.axis);
    const Profile profile(shell);
    double foot = profile.foot(at.distance - shell.radius_base, at.height);
    const bool beyond_end = foot < 0.0 || foot > profile.size;
    if (std::abs(profile.depth(at.distance - shell.radius_base, at.height)) - probe.radius > probe.margin) return;
    const Vec3 nearest_outward = at.outward(shell.axis);
    for (std::uint32_t k = 0; k < 3; ++k) {
        // The centre in the frame of half-plane k: `x` away from the axis, `y` out of the plane.
        const double x = kThirds[k].cosine * at.distance, y = -kThirds[k].sine * at.distance;
        const Vec3 outward = kThirds[k].of(nearest_outward, shell.axis);
        const Vec3 normal = profile.t_radial * shell.axis - profile.t_axial * outward;  // towards the axis
        if (!beyond_end) foot = profile.foot(x - shell.radius_base, at.height);         // else all three are on one rim
        if (foot >= 0.0 && foot <= profile.size) {
            const double depth = profile.depth(x - shell.radius_base, at.height);
            const double gap = std::abs(depth) - probe.radius;
            const bool from_inside = depth > 0.0 || (depth == 0.0 && shell.inside);
            if (gap <= probe.margin) out.add(from_inside ? normal : Vec3(-normal), gap, k);
            if (!from_inside) return;
        } else {
            const double rim = foot < 0.0 ? shell.radius_base : shell.radius_end;
            const double height = foot < 0.0 ? at.height : at.height - shell.length;
            add_point((x - rim) * outward + y * shell.axis.cross(outward) + height * shell.axis, normal, probe, k, out);
            if (rim == 0.0) return;  // an apex is one point
        }
        if (out.count == 0) return;  // the first is the nearest
    }
}

void cone_contacts(const ConeWall& cone, const Probe& probe, WallContacts& out) {
    shell_contacts({cone.base, cone.axis, cone.radius_base, cone.radius_end, cone.length, cone.inside}, probe, out);
}

}  // namespace scree::contact::detail
