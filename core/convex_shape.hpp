// A convex polyhedron in its body frame: the origin is its centre of mass, the axes are its principal axes of inertia.
//
//   V = int dV,   J = int diag(y^2 + z^2, x^2 + z^2, x^2 + y^2) dV      (mass and inertia are the density times these)
//
// by the divergence theorem over the faces (Mirtich 1996). Faces are planar polygons, not triangles: coplanar ones are
// merged. Bodies share one shape; it knows nothing of where they are.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.hpp"

namespace scree {

struct ConvexShape {
    struct Face {
        Vec3 normal;                 // outward, unit
        double offset;               // [m] normal . x on the face
        std::uint32_t begin, count;  // its corners in `corner`, counter-clockwise seen from outside
    };
    struct Edge {
        std::uint32_t from, to;     // vertices
        std::uint32_t left, right;  // faces: `left` has the edge from `from` to `to`, `right` the other way round
    };

    std::vector<Vec3> vertex;                     // [m]
    std::vector<Face> face;                       //
    std::vector<std::uint32_t> corner;            // vertices of all faces, face by face
    std::vector<Edge> edge;                       // each once, from < to
    std::vector<std::uint32_t> link_begin, link;  // vertices joined to each by an edge, increasing

    double volume = 0.0;          // V [m3]
    Vec3 inertia = Vec3::Zero();  // J [m5], increasing
    double radius = 0.0;          // [m] of the smallest ball about the centre of mass that holds it
    double inner_radius = 0.0;    // [m] of the largest ball about the centre of mass inside of it

    std::span<const std::uint32_t> corners(std::size_t f) const {
        return {corner.data() + face[f].begin, face[f].count};
    }
    std::span<const std::uint32_t> links(std::size_t v) const {
        return {link.data() + link_begin[v], link.data() + link_begin[v + 1]};
    }
};

// Makes `link_begin` and `link` from the edges.
void link_vertices(ConvexShape& shape);

}  // namespace scree
