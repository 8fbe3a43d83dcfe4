// A sphere (a) and one triangle of a terrain (b), by the Voronoi region that the centre x lies in:
//   over the triangle    gap = n . (x - p) - R, normal n, also when the centre is behind it by up to `depth`
//                        (and behind its neighbours beyond ridges: else it has come out on the other side)
//   beside a ridge       gap = |x - y| - R, y the foot on the edge: x lies over neither of its triangles, and outside
//   about a vertex       the same with y the vertex: x lies beyond the ends of all edges that meet there, and outside
// Of the triangles that share an edge or a vertex the first one answers for it, so all triangles near a sphere together
// report each place once. Which side of an edge x is on is asked with the same numbers for both of its triangles: no
// slit between regions. Outside, gaps and normals are continuous over ridges; in a valley two triangles are touched.
#pragma once

#include <optional>

#include "contact/polyhedra/sphere_polyhedron.hpp"
#include "core/terrain_mesh.hpp"

namespace scree::contact {

struct SphereTriangleGap {
    double gap;             // [m]
    Vec3 normal;            // unit, from the terrain to the sphere
    Region region;          //
    std::uint32_t feature;  // index of the triangle, edge or vertex in the mesh
};

std::optional<SphereTriangleGap> sphere_triangle(const Vec3& centre, double radius, const TerrainMesh& mesh,
                                                 std::uint32_t triangle, double depth, double margin);

}  // namespace scree::contact
