// A sphere (a) and a convex polyhedron (b):
//   gap = |x - y| - R, y the point of b nearest to the centre x, normal = (x - y) / |x - y|     x outside
//   gap = max over faces of (n_f . x - o_f) - R, normal = n_f                                   x inside
// The faces in sight of the centre decide (Ericson 2005, 5.1): where the centre lies over the one it is farthest from,
// that face is nearest; else an edge or vertex of a face in sight. Gap and normal are continuous from region to region,
// except inside on the surface of points that are equally deep under two faces; there the first of equals is taken.
#pragma once

#include "contact/polyhedra/placed.hpp"

namespace scree::contact {

enum class Region : std::uint32_t { face = 0, edge = 1, vertex = 2 };

struct SpherePolyhedronGap {
    double gap;   // [m]
    Vec3 normal;  // unit, from the polyhedron to the sphere
    Region region;
    std::uint32_t feature;  // index of the face, edge or vertex

    // Stays the same while the sphere stays in the region.
    std::uint32_t key() const { return static_cast<std::uint32_t>(region) << 30U | feature; }
};

SpherePolyhedronGap sphere_polyhedron(const Vec3& centre, double radius, const Placed& body);

}  // namespace scree::contact
