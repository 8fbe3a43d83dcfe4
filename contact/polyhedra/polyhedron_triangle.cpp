#include "contact/polyhedra/polyhedron_triangle.hpp"

#include "contact/polyhedra/gauss_map.hpp"
#include "contact/polyhedra/patch.hpp"

namespace scree::contact {
namespace {

using Edge = TerrainMesh::Edge;
using Triangle = TerrainMesh::Triangle;

constexpr double kRoundOff = 1e-12;
constexpr double kValley = 1e-6;  // sine of the angle by which the ground rises beyond a valley

// The triangle as the top of a prism that has no bottom. Nothing is allocated after the first one.
Placed upright(const TerrainMesh& mesh, const Triangle& t, PolyhedraScratch& scratch) {
    ConvexShape& shape = scratch.triangle;
    shape.vertex.resize(3), shape.face.resize(4), shape.edge.resize(3), scratch.triangle_room.resize(7);
    const Vec3 middle = (mesh.vertex[t.corner[0]] + mesh.vertex[t.corner[1]] + mesh.vertex[t.corner[2]]) / 3.0;
    Vec3 *vertex = scratch.triangle_room.data(), *normal = vertex + 3;
    shape.radius = shape.inner_radius = 0.0;
    for (std::uint32_t i = 0; i < 3; ++i) {
        vertex[i] = mesh.vertex[t.corner[i]] - middle;
        shape.radius = std::max(shape.radius, vertex[i].norm());
    }
    normal[0] = t.normal;
    shape.face[0].offset = t.normal.dot(vertex[0]);
    for (std::uint32_t i = 0; i < 3; ++i) {
        normal[i + 1] = (vertex[(i + 1) % 3] - vertex[i]).cross(t.normal).normalized();
        shape.face[i + 1].offset = normal[i + 1].dot(vertex[i]);
        shape.edge[i] = {i, (i + 1) % 3, 0, i + 1};
    }
    return {&shape, middle, {vertex, 3}, {normal, 4}};
}

struct Direction {
    double separation;  // [m]
    Vec3 normal;
    bool own;   // the triangle's
    bool ours;  // a feature that this triangle speaks for
};

std::uint32_t beyond(const Edge& edge, std::uint32_t triangle) {
    return edge.left == triangle ? edge.right : edge.left;
}

// Directions across a ridge and an edge of the body.
void ridges(const Placed& body, const Placed& prism, const TerrainMesh& mesh, std::uint32_t triangle, Direction& best) {
    const Triangle& t = mesh.triangle[triangle];
    const Vec3 r = body.position - prism.position;
    for (std::size_t i = 0; i < 3; ++i) {
        const Edge& edge = mesh.edge[t.edge[i]];
        if (!edge.convex) continue;
        const std::uint32_t other = beyond(edge, triangle);
        const Vec3 right = other == TerrainMesh::kNone ? prism.normal[i + 1] : mesh.triangle[other].normal;
        const detail::Arc ridge(prism.vertex[(i + 1) % 3] - prism.vertex[i], t.normal, right, prism.vertex[i]);
        for (std::uint32_t e = 0; e < body.shape->edge.size(); ++e) {
            const detail::Arc arc(body, e);
            Vec3 normal;
            if (!detail::cross(ridge, arc) || !detail::across_edges(ridge, arc, normal)) continue;
            if (normal.dot(arc.point + r - ridge.point) <= best.separation) continue;
            const double s = separation(body, prism, normal);
            if (s > best.separation) best = {s, normal, false, edge.owner() == triangle};
        }
    }
}

bool in_cone(const TerrainMesh& mesh, std::uint32_t v, const Vec3& direction) {
    if (direction.dot(mesh.outward[v]) <= 0.0) return false;
    for (const std::uint32_t w : mesh.links(v)) {
        if (direction.dot(mesh.vertex[w] - mesh.vertex[v]) > 0.0) return false;
    }
    return true;
}

// Directions of faces of the body, on a vertex.
void vertices(const Placed& body, const Placed& prism, const TerrainMesh& mesh, std::uint32_t triangle,
              Direction& best) {
    const Triangle& t = mesh.triangle[triangle];
    const Vec3 r = prism.position - body.position;
    for (std::size_t f = 0; f < body.normal.size(); ++f) {
        const Extreme nearest = lowest(prism, body.normal[f]);
        const double s = nearest.height + body.normal[f].dot(r) - body.offset(f);
        const std::uint32_t v = t.corner[nearest.vertex];
        if (s <= best.separation || !in_cone(mesh, v, -body.normal[f])) continue;
        best = {s, -body.normal[f], false, mesh.owner[v] == triangle};
    }
}

// The centre, behind the triangle, has come out on the far side of one of its ridges.
bool on_the_far_side(const TerrainMesh& mesh, std::uint32_t triangle, const Vec3& centre) {
    const Triangle& t = mesh.triangle[triangle];
    if (t.normal.dot(centre - mesh.vertex[t.corner[0]]) >= 0.0) return false;
    for (const std::uint32_t e : t.edge) {
        const Edge& edge = mesh.edge[e];
        const std::uint32_t other = beyond(edge, triangle);
        if (!edge.convex || other == TerrainMesh::kNone) continue;
        if (mesh.triangle[other].normal.dot(centre - mesh.vertex[edge.from]) > 0.0) return true;
    }
    return false;
}

// The surface goes on there: no corner of it.
bool inner(const TerrainMesh& mesh, const Triangle& t, FeatureKey key) {
    const auto meeting = static_cast<Meeting>(key >> 30U);
    const std::uint32_t feature = key & (kMostFeatures - 1);
    if (meeting == Meeting::edges) return !mesh.edge[t.edge[feature]].convex;
    return meeting == Meeting::vertex_of_b && !mesh.on_ridge[t.corner[feature]];
}

// The ground rises beyond this edge of the triangle.
bool is_valley(const TerrainMesh& mesh, std::uint32_t triangle, std::uint32_t which) {
    const Edge& edge = mesh.edge[mesh.triangle[triangle].edge[which]];
    const std::uint32_t other = beyond(edge, triangle);
    if (edge.convex || other == TerrainMesh::kNone) return false;
    const Vec3& into = edge.left == triangle ? edge.into_left : edge.into_right;
    return mesh.triangle[other].normal.dot(into) > kValley;
}

// A point on a valley, or a corner in one, that is inside the body. Below a valley there is a wedge where no triangle
// has ground along its normal: what sinks in there is felt by these points alone.
bool sunk_valley(const TerrainMesh& mesh, std::uint32_t triangle, const ManifoldPoint& p, double radius) {
    if (!(p.gap < -kRoundOff * radius)) return false;
    const std::uint32_t feature = p.key & (kMostFeatures - 1);
    if (is_valley(mesh, triangle, feature)) return true;
    return static_cast<Meeting>(p.key >> 30U) == Meeting::vertex_of_b && is_valley(mesh, triangle, (feature + 2) % 3);
}

}  // namespace

bool polyhedron_triangle(const Placed& body, const TerrainMesh& mesh, std::uint32_t triangle, double depth,
                         double margin, PolyhedraScratch& scratch, Manifold& out) {
    out.count = 0, out.area = 0.0;
    const Triangle& t = mesh.triangle[triangle];
    const double height = t.normal.dot(body.position - mesh.vertex[t.corner[0]]);
    if (height - body.shape->radius > margin || height + body.shape->radius < -depth) return false;
    const Placed prism = upright(mesh, t, scratch);
    const double reach = body.shape->radius + prism.shape->radius + margin + depth;
    if ((body.position - prism.position).squaredNorm() > reach * reach) return false;
    Direction best{height + lowest(body, t.normal).height, t.normal, true, true};
    if (best.separation > margin) return false;
    // Another direction must be better by more than round-off; where the centre is on the far side any one is.
    best.separation += kRoundOff * body.shape->radius;
    if (on_the_far_side(mesh, triangle, body.position)) {
        best = {-std::numeric_limits<double>::infinity(), t.normal, true, false};
    }
    vertices(body, prism, mesh, triangle, best);
    ridges(body, prism, mesh, triangle, best);
    if (best.separation > margin || best.separation < -depth || !best.ours) return false;
    contact_patch(body, prism, best.normal, margin, scratch, out);
    int kept = 0;
    for (int i = 0; i < out.count; ++i) {
        ManifoldPoint p = out.item[static_cast<std::size_t>(i)];
        if (best.own && inner(mesh, t, p.key) && !sunk_valley(mesh, triangle, p, body.shape->radius)) continue;
        p.point += prism.position;
        out.item[static_cast<std::size_t>(kept++)] = p;
    }
    out.count = kept;
    return kept > 0;
}

}  // namespace scree::contact
