// Terrain: the triangles near the sphere, by sphere_triangle.hpp. One-sided.
//   outside  each face, ridge and summit that is nearest to the centre among the places around it, as far as the margin
//   behind   one place: the nearest of the surface, with the normal towards it
// A height field is solid ground: a centre below it is behind, however deep (beyond two radii straight up is the way
// out). Behind any other surface it is one whose nearest place shows its back, as far as
// terrain_depth(): farther it may be another hall of the same cave; beyond the edge of a sheet nothing is behind.
// Feature: region << 30 | index of the triangle, edge or vertex; kBeyond the border of a closed height field.
#include <algorithm>

#include "contact/polyhedra/sphere_triangle.hpp"
#include "contact/walls/nearest_place.hpp"
#include "contact/walls/shapes.hpp"
#include "core/terrain.hpp"

namespace scree::contact::detail {
namespace {

constexpr std::uint32_t kBeyond = 3U << 30U;
constexpr double kSearched = 2.0;  // [radii] farther than this into the ground nobody looks for the nearest place
constexpr double kAlike = 1e-12;   // relative: places that differ by less are one
constexpr double kRoundOff = 1e-9;

std::uint32_t feature_of(Region region, std::uint32_t index) {
    return static_cast<std::uint32_t>(region) << 30U | index;
}

bool deeper(const WallContact& a, const WallContact& b) {
    return a.gap != b.gap ? a.gap < b.gap : a.feature < b.feature;
}

void keep_deepest(const WallContact& contact, WallContacts& out) {
    if (out.count < WallContacts::kCapacity) return out.add(contact.normal, contact.gap, contact.feature);
    const auto shallowest = std::max_element(out.item.begin(), out.item.end(), deeper);
    if (deeper(contact, *shallowest)) *shallowest = contact;
}

// The surface ends at this place of the triangle.
bool ends(const TerrainMesh& mesh, std::uint32_t triangle, const NearestPlace& place) {
    for (const std::uint32_t e : mesh.triangle[triangle].edge) {
        const TerrainMesh::Edge& edge = mesh.edge[e];
        if (edge.left != TerrainMesh::kNone && edge.right != TerrainMesh::kNone) continue;
        if (place.region == Region::edge && place.feature == e) return true;
        if (place.region == Region::vertex && (place.feature == edge.from || place.feature == edge.to)) return true;
    }
    return false;
}

struct Place {
    double distance = std::numeric_limits<double>::infinity();  // [m]
    std::uint32_t triangle = TerrainMesh::kNone;
    bool at_end = false;  // the surface ends there
    NearestPlace at{};

    void take(const TerrainMesh& mesh, std::uint32_t t, const Vec3& x) {
        const NearestPlace place = nearest_place(mesh, t, x);
        const double d = (x - place.foot).norm();
        const bool nearer = d < (1.0 - kAlike) * distance;
        if (!nearer && d > (1.0 + kAlike) * distance) return;
        at_end = (!nearer && at_end) || ends(mesh, t, place);
        if (nearer) distance = d, triangle = t, at = place;
    }
    // Which side of the surface x is on: the mean normal of its nearest place tells (Baerentzen and Aanaes 2005).
    bool shows_back(const TerrainMesh& mesh, const Vec3& x) const {
        Vec3 normal = mesh.triangle[triangle].normal;
        if (at.region == Region::edge) {
            const TerrainMesh::Edge& edge = mesh.edge[at.feature];
            for (const std::uint32_t side : {edge.left, edge.right})
                if (side != TerrainMesh::kNone && side != triangle) normal += mesh.triangle[side].normal;
        }
        if (at.region == Region::vertex) normal = mesh.outward[at.feature];
        return normal.dot(x - at.foot) < 0.0;
    }
};

Vec3 reach(double r) {
    return Vec3::Constant(r);
}

Place nearest(const Terrain& terrain, const Vec3& x, double within) {
    Place best;
    terrain.visit(x - reach(within), x + reach(within), [&](std::uint32_t t) { best.take(terrain.mesh, t, x); });
    return best;
}

// The centre is behind the place.
void push_out(const Terrain& terrain, const Place& place, const Probe& probe, WallContacts& out) {
    const Vec3& n = terrain.mesh.triangle[place.triangle].normal;
    const bool noise = place.distance <= kRoundOff * probe.radius || place.at.region == Region::face;
    const Vec3 normal = noise ? n : Vec3(((place.at.foot - probe.centre) / place.distance).normalized());
    out.add(normal, -place.distance - probe.radius, feature_of(place.at.region, place.at.feature));
}

void push_up(const Terrain& terrain, std::uint32_t above, const Probe& probe, WallContacts& out) {
    const TerrainMesh::Triangle& t = terrain.mesh.triangle[above];
    const double depth = -t.normal.dot(probe.centre - terrain.mesh.vertex[t.corner[0]]) / t.normal.z();
    const double searched = std::min(depth, kSearched * probe.radius) * (1.0 + kRoundOff);
    const Place place = nearest(terrain, probe.centre, searched);
    if (place.distance <= searched) return push_out(terrain, place, probe, out);
    out.add(Vec3::UnitZ(), -depth - probe.radius, feature_of(Region::face, above));
}

// From beyond the border of a closed height field, the nearest way back.
void push_in(const HeightGrid& grid, const Probe& probe, WallContacts& out) {
    const Vec3& x = probe.centre;
    const Vec3 back(std::clamp(x.x(), grid.x, grid.last_x()) - x.x(), std::clamp(x.y(), grid.y, grid.last_y()) - x.y(),
                    0.0);
    const auto side = [](double d) { return d > 0.0 ? 1U : d < 0.0 ? 2U : 0U; };
    const double distance = length_of(back);
    out.add((back / distance).normalized(), -distance - probe.radius, kBeyond + side(back.x()) + 3 * side(back.y()));
}

// Surfaces that are no height field, and walls around holes, which nobody is far behind.
bool behind(const Terrain& terrain, const Probe& probe, WallContacts& out) {
    const double depth = terrain_depth(probe.radius);
    const Place place = nearest(terrain, probe.centre, depth);
    if (place.distance > depth || place.at_end || !place.shows_back(terrain.mesh, probe.centre)) return false;
    push_out(terrain, place, probe, out);
    return true;
}

bool far_above(const Terrain& terrain, const Probe& probe) {
    const bool walls = terrain.border == TerrainBorder::closed;
    return probe.centre.z() - probe.radius - probe.margin > (walls ? terrain.top : terrain.upper.z());
}

}  // namespace

void terrain_contacts(const TerrainWall& wall, const Probe& probe, WallContacts& out) {
    const Terrain& terrain = *wall.terrain;
    if (far_above(terrain, probe)) return;
    const auto column = terrain.column(probe.centre.x(), probe.centre.y());
    if (terrain.under(probe.centre, column)) return push_up(terrain, *column, probe, out);
    if (terrain.outside(probe.centre)) return push_in(*terrain.grid, probe, out);
    if (!column && behind(terrain, probe, out)) return;
    const Vec3 around = reach(probe.radius + probe.margin);
    terrain.visit(probe.centre - around, probe.centre + around, [&](std::uint32_t t) {
        const auto found = sphere_triangle(probe.centre, probe.radius, terrain.mesh, t, 0.0, probe.margin);
        if (found) keep_deepest({found->normal, found->gap, feature_of(found->region, found->feature)}, out);
    });
    std::sort(out.item.begin(), out.item.begin() + out.count,
              [](const WallContact& a, const WallContact& b) { return a.feature < b.feature; });
}

std::optional<std::uint32_t> terrain_triangle(const Terrain& terrain, std::uint32_t feature) {
    const std::uint32_t index = feature & ~kBeyond;
    switch (static_cast<Region>(feature >> 30U)) {
        case Region::face:
            return index;
        case Region::edge:
            return terrain.mesh.edge[index].owner();
        case Region::vertex:
            return terrain.mesh.owner[index];
    }
    return std::nullopt;
}

// A centre on the other side of the surface, or beyond the border, is farther away than what lies between.
bool near_terrain(const TerrainWall& wall, const Probe& probe) {
    const Terrain& terrain = *wall.terrain;
    if (far_above(terrain, probe)) return false;
    const Vec3& x = probe.centre;
    if (terrain.under(x) || terrain.outside(x)) return true;
    if (terrain.grid) {
        const HeightGrid& grid = *terrain.grid;
        const double beside =
            std::min(std::min(x.x() - grid.x, grid.last_x() - x.x()), std::min(x.y() - grid.y, grid.last_y() - x.y()));
        const bool closed = terrain.border == TerrainBorder::closed;
        if (closed && (beside <= probe.margin || !terrain.column(x.x(), x.y()))) return true;
        if (!closed && std::abs(x.z() - terrain.bottom) <= probe.margin && beside >= -probe.margin) return true;
    }
    const double width = (probe.radius + probe.margin) * (1.0 + kRoundOff);
    bool found = false;
    terrain.visit(x - reach(width), x + reach(width), [&](std::uint32_t t) {
        found = found || (x - nearest_place(terrain.mesh, t, x).foot).norm() <= width;
    });
    return found;
}

}  // namespace scree::contact::detail
