// Boxes along the axes of the wall's frame.
//   closed, inside:  six one-sided planes: nothing gets out
//   open, inside:    thin sides (and bottom). A body with its centre in the box touches each face from inside; one
//   above
//                    an open end touches the rim's edges; one elsewhere touches the box from outside, as it would a
//                    solid
//   outside:         a solid; a centre inside it is pushed out through the nearest face, the first of equals
// Features: 0 to 5 are the faces x-, x+, y-, y+, z-, z+ from inside, and the rim edges above the faces; kOutside + code
// is a place on the outside, code = sum of 3^i (0 below, 1 within, 2 above the box in coordinate i).
#include "contact/walls/shapes.hpp"

namespace scree::contact::detail {
namespace {

constexpr std::uint32_t kOutside = 6;
constexpr std::uint32_t kPower[3] = {1, 3, 9};
constexpr std::uint32_t kWithin = 13;  // the code of a point inside

Vec3 face_normal(int coordinate, bool upper) {
    Vec3 normal = Vec3::Zero();
    normal[coordinate] = upper ? 1.0 : -1.0;
    return normal;
}

void faces_from_inside(const BoxWall& box, const Probe& probe, WallContacts& out) {
    for (int i = 0; i < 3; ++i) {
        const double below = probe.centre[i] - box.lower[i] - probe.radius;
        const double above = box.upper[i] - probe.centre[i] - probe.radius;
        const auto feature = static_cast<std::uint32_t>(2 * i);
        if (below <= probe.margin && !(i == 2 && box.open_bottom)) out.add(face_normal(i, true), below, feature);
        if (above <= probe.margin && !(i == 2 && box.open_top)) out.add(face_normal(i, false), above, feature + 1);
    }
}

std::uint32_t outside_code(const BoxWall& box, const Vec3& x) {
    std::uint32_t code = 0;
    for (int i = 0; i < 3; ++i) code += kPower[i] * (x[i] < box.lower[i] ? 0U : x[i] > box.upper[i] ? 2U : 1U);
    return code;
}

void push_out(const BoxWall& box, const Probe& probe, WallContacts& out) {
    int nearest = 0;
    bool upper = false;
    double depth = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const double below = probe.centre[i] - box.lower[i], above = box.upper[i] - probe.centre[i];
        if (below < depth) nearest = i, upper = false, depth = below;
        if (above < depth) nearest = i, upper = true, depth = above;
    }
    const auto n = static_cast<std::size_t>(nearest);
    const std::uint32_t code = upper ? kWithin + kPower[n] : kWithin - kPower[n];
    if (-depth - probe.radius <= probe.margin) {
        out.add(face_normal(nearest, upper), -depth - probe.radius, kOutside + code);
    }
}

void nearest_from_outside(const BoxWall& box, const Probe& probe, WallContacts& out) {
    const std::uint32_t code = outside_code(box, probe.centre);
    if (code == kWithin) return push_out(box, probe, out);
    const Vec3 nearest = probe.centre.cwiseMax(box.lower).cwiseMin(box.upper);
    // Not on the point: at least one coordinate differs, so the fallback is never used.
    add_point(probe.centre - nearest, Vec3::UnitZ(), probe, kOutside + code, out);
}

// The centre is beyond an open end at height `z`: edges whose nearest point is not an end, or the nearest corner.
void rim(const BoxWall& box, double z, const Probe& probe, WallContacts& out) {
    const Vec3& c = probe.centre;
    bool beside_edge = false;
    for (int i = 0; i < 2; ++i) {
        const int along = 1 - i;
        if (c[along] < box.lower[along] || c[along] > box.upper[along]) continue;
        beside_edge = true;
        Vec3 point(c.x(), c.y(), z);
        point[i] = box.lower[i];
        add_point(c - point, Vec3::UnitZ(), probe, static_cast<std::uint32_t>(2 * i), out);
        point[i] = box.upper[i];
        add_point(c - point, Vec3::UnitZ(), probe, static_cast<std::uint32_t>(2 * i) + 1, out);
    }
    if (!beside_edge) nearest_from_outside(box, probe, out);
}

}  // namespace

void box_contacts(const BoxWall& box, const Probe& probe, WallContacts& out) {
    if (!box.inside) return nearest_from_outside(box, probe, out);
    if (!box.open_top && !box.open_bottom) return faces_from_inside(box, probe, out);
    if (box.open_top && probe.centre.z() > box.upper.z()) return rim(box, box.upper.z(), probe, out);
    if (box.open_bottom && probe.centre.z() < box.lower.z()) return rim(box, box.lower.z(), probe, out);
    if (outside_code(box, probe.centre) == kWithin) return faces_from_inside(box, probe, out);
    nearest_from_outside(box, probe, out);
}

}  // namespace scree::contact::detail
