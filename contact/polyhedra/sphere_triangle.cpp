#include "contact/polyhedra/sphere_triangle.hpp"

#include <algorithm>
#include <cmath>

namespace scree::contact {
namespace {

using Edge = TerrainMesh::Edge;

// Where many regions meet, straight above a vertex, round-off must not leave a slit between them.
constexpr double kRoundOff = 1e-14;
constexpr double kSpare = 1e-9;

// How far x lies on the triangle's side of the edge [m], along its plane.
double inward(const TerrainMesh& mesh, const Edge& edge, std::uint32_t triangle, const Vec3& x) {
    const Vec3& into = edge.left == triangle ? edge.into_left : edge.into_right;
    return (x - mesh.vertex[edge.from]).dot(into);
}

bool over(const TerrainMesh& mesh, const Edge& edge, std::uint32_t triangle, const Vec3& x) {
    return inward(mesh, edge, triangle, x) > 0.0;
}

// x lies beyond the end `v` of the edge to `w`.
bool beyond(const TerrainMesh& mesh, std::uint32_t v, std::uint32_t w, const Vec3& x) {
    return (x - mesh.vertex[v]).dot(mesh.vertex[w] - mesh.vertex[v]) <= 0.0;
}

bool in_region(const TerrainMesh& mesh, const Edge& edge, const Vec3& x) {
    if (beyond(mesh, edge.from, edge.to, x) || beyond(mesh, edge.to, edge.from, x)) return false;
    Vec3 outward = Vec3::Zero();
    for (const std::uint32_t t : {edge.left, edge.right}) {
        if (t == TerrainMesh::kNone) continue;
        if (over(mesh, edge, t, x)) return false;
        outward += mesh.triangle[t].normal;
    }
    return (x - mesh.vertex[edge.from]).dot(outward) >= 0.0;
}

bool in_region(const TerrainMesh& mesh, std::uint32_t v, const Vec3& x) {
    const Vec3 d = x - mesh.vertex[v];
    const double distance = d.norm();
    for (const std::uint32_t w : mesh.links(v)) {
        const Vec3 along = mesh.vertex[w] - mesh.vertex[v];
        if (d.dot(along) > kRoundOff * distance * along.norm()) return false;
    }
    return d.dot(mesh.outward[v]) >= 0.0;
}

// x, behind the triangle, has come out on the far side of one of its ridges.
bool before_a_ridge(const TerrainMesh& mesh, const TerrainMesh::Triangle& t, const Vec3& x) {
    for (const std::uint32_t e : t.edge) {
        const Edge& edge = mesh.edge[e];
        if (!edge.convex) continue;
        for (const std::uint32_t side : {edge.left, edge.right}) {
            if (side == TerrainMesh::kNone) continue;
            if (mesh.triangle[side].normal.dot(x - mesh.vertex[edge.from]) > 0.0) return true;
        }
    }
    return false;
}

std::optional<SphereTriangleGap> from_foot(const Vec3& d, const Vec3& otherwise, double radius, double margin,
                                           Region region, std::uint32_t feature) {
    const double distance = d.norm();
    if (distance - radius > margin) return std::nullopt;
    const Vec3 normal = distance > 0.0 ? Vec3((d / distance).normalized()) : Vec3(otherwise.normalized());
    return SphereTriangleGap{distance - radius, normal, region, feature};
}

}  // namespace

std::optional<SphereTriangleGap> sphere_triangle(const Vec3& centre, double radius, const TerrainMesh& mesh,
                                                 std::uint32_t triangle, double depth, double margin) {
    const TerrainMesh::Triangle& t = mesh.triangle[triangle];
    const double height = t.normal.dot(centre - mesh.vertex[t.corner[0]]);
    // where a ridge is sharp, what lies beyond it is behind one of its triangles
    if (height - radius > margin || height < -std::max(depth, radius + margin)) return std::nullopt;
    // beside the triangle by more than this squared, none of its edges and vertices is near enough
    const double beside = (1.0 + kSpare) * (radius + margin) * (radius + margin) - height * height;
    bool inside = true;
    for (const std::uint32_t e : t.edge) {
        const double in = inward(mesh, mesh.edge[e], triangle, centre);
        if (in > 0.0) continue;
        if (in * in > beside) return std::nullopt;
        inside = false;
    }
    if (inside && (height < -depth || (height < 0.0 && before_a_ridge(mesh, t, centre)))) return std::nullopt;
    if (inside) return SphereTriangleGap{height - radius, t.normal, Region::face, triangle};
    for (const std::uint32_t e : t.edge) {
        const Edge& edge = mesh.edge[e];
        if (edge.owner() != triangle || !in_region(mesh, edge, centre)) continue;
        const Vec3 along = (mesh.vertex[edge.to] - mesh.vertex[edge.from]).normalized();
        const Vec3 d = centre - mesh.vertex[edge.from];
        return from_foot(d - d.dot(along) * along, t.normal, radius, margin, Region::edge, e);
    }
    for (const std::uint32_t v : t.corner) {
        if (mesh.owner[v] != triangle || !in_region(mesh, v, centre)) continue;
        return from_foot(centre - mesh.vertex[v], mesh.outward[v], radius, margin, Region::vertex, v);
    }
    return std::nullopt;
}

}  // namespace scree::contact
