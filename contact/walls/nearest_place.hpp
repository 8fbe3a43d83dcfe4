// The place of a triangle that is nearest to a point (Ericson 2005, 5.1.5). Private to contact/.
#pragma once

#include "contact/polyhedra/sphere_polyhedron.hpp"
#include "core/terrain_mesh.hpp"

namespace scree::contact::detail {

struct NearestPlace {
    Vec3 foot;              // [m]
    Region region;          //
    std::uint32_t feature;  // index of the triangle, edge or vertex in the mesh
};

inline NearestPlace nearest_place(const TerrainMesh& mesh, std::uint32_t triangle, const Vec3& x) {
    const TerrainMesh::Triangle& t = mesh.triangle[triangle];
    const Vec3 &a = mesh.vertex[t.corner[0]], &b = mesh.vertex[t.corner[1]], &c = mesh.vertex[t.corner[2]];
    const Vec3 ab = b - a, ac = c - a, ax = x - a;
    const auto vertex = [&](std::size_t i) {
        return NearestPlace{mesh.vertex[t.corner[i]], Region::vertex, t.corner[i]};
    };
    const double d1 = ab.dot(ax), d2 = ac.dot(ax);
    if (d1 <= 0.0 && d2 <= 0.0) return vertex(0);
    const Vec3 bx = x - b;
    const double d3 = ab.dot(bx), d4 = ac.dot(bx);
    if (d3 >= 0.0 && d4 <= d3) return vertex(1);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {a + d1 / (d1 - d3) * ab, Region::edge, t.edge[0]};
    const Vec3 cx = x - c;
    const double d5 = ab.dot(cx), d6 = ac.dot(cx);
    if (d6 >= 0.0 && d5 <= d6) return vertex(2);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {a + d2 / (d2 - d6) * ac, Region::edge, t.edge[2]};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
        return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), Region::edge, t.edge[1]};
    }
    return {x - t.normal.dot(ax) * t.normal, Region::face, triangle};
}

}  // namespace scree::contact::detail
