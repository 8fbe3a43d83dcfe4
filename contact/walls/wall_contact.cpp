// Which shape's function answers, and what is known of a shape without looking at a body.
#include "contact/walls/wall_contact.hpp"

#include "contact/walls/shapes.hpp"
#include "core/terrain.hpp"

namespace scree::contact {
namespace {

template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

const Vec3 kInfinite = Vec3::Constant(kForever);

// Half the extent of a circle of this radius about an axis.
Vec3 circle_extent(const Vec3& axis, double radius) {
    return radius * (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
}

// The two ends of a surface of revolution; an infinite one is bounded only across an axis of the frame.
WallBounds revolution_bounds(const Vec3& base, const Vec3& axis, double length, double radius_base, double radius_end) {
    WallBounds box;
    const Vec3 at_base = circle_extent(axis, radius_base), at_end = circle_extent(axis, radius_end);
    for (int i = 0; i < 3; ++i) {
        if (std::isinf(length)) {
            box.lower[i] = axis[i] == 0.0 ? base[i] - at_base[i] : -kForever;
            box.upper[i] = axis[i] == 0.0 ? base[i] + at_base[i] : kForever;
        } else {
            const double end = base[i] + length * axis[i];
            box.lower[i] = std::min(base[i] - at_base[i], end - at_end[i]);
            box.upper[i] = std::max(base[i] + at_base[i], end + at_end[i]);
        }
    }
    return box;
}

// A plane along two axes of the frame is bounded on the third; one-sided: only on the side of the normal.
WallBounds plane_bounds(const Vec3& point, const Vec3& normal, bool one_sided) {
    WallBounds box{-kInfinite, kInfinite};
    for (int i = 0; i < 3; ++i) {
        if (std::abs(normal[i]) != 1.0) continue;
        if (!one_sided || normal[i] < 0.0) box.lower[i] = point[i];
        if (!one_sided || normal[i] > 0.0) box.upper[i] = point[i];
    }
    return box;
}

// A height field is solid below; if it is closed, nothing may be beside it.
WallBounds terrain_bounds(const Terrain& terrain) {
    WallBounds box{terrain.lower, terrain.upper};
    const bool closed = terrain.border == TerrainBorder::closed;
    if (terrain.ground < terrain.mesh.triangle.size()) {
        if (closed) box.upper.z() = terrain.top;
        if (!closed) box.lower.z() = terrain.bottom;
    }
    if (!closed || !terrain.grid) return box;
    const double top = box.upper.z();
    box = {-kInfinite, kInfinite};
    box.upper.z() = top;
    return box;
}

bool keeps_everything(const BoxWall& box) {
    return box.inside && !box.open_top && !box.open_bottom;
}
bool keeps_everything(const CylinderWall& cylinder) {
    return cylinder.inside && std::isinf(cylinder.length);
}

}  // namespace

void find_contacts(const WallShape& shape, const Vec3& centre, double radius, double margin, WallContacts& out) {
    out.count = 0;
    const detail::Probe probe{centre, radius, margin};
    std::visit(Overloaded{[&](const PlaneWall& w) { detail::plane_contacts(w, probe, out); },
                          [&](const BoxWall& w) { detail::box_contacts(w, probe, out); },
                          [&](const CylinderWall& w) { detail::cylinder_contacts(w, probe, out); },
                          [&](const ConeWall& w) { detail::cone_contacts(w, probe, out); },
                          [&](const DiscWall& w) { detail::disc_contacts(w, probe, out); },
                          [&](const OrificeFloor& w) { detail::orifice_floor_contacts(w, probe, out); },
                          [&](const SlotFloor& w) { detail::slot_floor_contacts(w, probe, out); },
                          [&](const TerrainWall& w) { detail::terrain_contacts(w, probe, out); }},
               shape);
}

bool may_touch(const WallShape& shape, const Vec3& centre, double radius, double reach) {
    if (const auto* terrain = std::get_if<TerrainWall>(&shape)) {
        return detail::near_terrain(*terrain, {centre, radius, reach});
    }
    WallContacts found;
    find_contacts(shape, centre, radius, reach, found);
    return found.count > 0;
}

bool has_zones(const WallShape& shape) {
    const auto* wall = std::get_if<TerrainWall>(&shape);
    return wall != nullptr && !wall->terrain->material.empty();
}

MaterialIndex material_at(const Wall& wall, std::uint32_t feature) {
    const Terrain& terrain = *std::get<TerrainWall>(wall.shape).terrain;
    const auto triangle = detail::terrain_triangle(terrain, feature);
    return triangle ? terrain.material_of(*triangle, wall.material) : wall.material;
}

bool is_thin(const WallShape& shape) {
    return std::visit(
        Overloaded{[](const PlaneWall&) { return false; }, [](const BoxWall& w) { return !keeps_everything(w); },
                   [](const CylinderWall& w) { return !keeps_everything(w); }, [](const auto&) { return true; }},
        shape);
}

WallBounds bounds(const WallShape& shape) {
    const WallBounds everywhere{-kInfinite, kInfinite};
    return std::visit(
        Overloaded{
            [](const PlaneWall& w) { return plane_bounds(w.point, w.normal, true); },
            [&](const BoxWall& w) {
                return keeps_everything(w) ? everywhere : WallBounds{w.lower, w.upper};
            },
            [&](const CylinderWall& w) {
                return keeps_everything(w) ? everywhere
                                           : revolution_bounds(w.base, w.axis, w.length, w.radius, w.radius);
            },
            [](const ConeWall& w) { return revolution_bounds(w.base, w.axis, w.length, w.radius_base, w.radius_end); },
            [](const DiscWall& w) { return revolution_bounds(w.centre, w.normal, 0.0, w.radius, w.radius); },
            [](const OrificeFloor& w) { return plane_bounds(w.centre, w.normal, false); },
            [](const SlotFloor& w) { return plane_bounds(w.centre, w.normal, false); },
            [](const TerrainWall& w) { return terrain_bounds(*w.terrain); }},
        shape);
}

}  // namespace scree::contact
