// The direction along which two convex polyhedra are farthest apart, or overlap the least, among the normals of the
// faces of their Minkowski difference:
//   s = max over n of [ min over a of n . x  -  max over b of n . x ],     n from b to a; s < 0: the depth is -s
// The faces are those of a, those of b, and for each pair of edges whose arcs cross on the Gauss map the parallelogram
// they span (Gottschalk, Lin, Manocha 1996; Gregorius 2013). If the bodies overlap, s is the exact depth, else a lower
// bound of the distance, which is exact where the nearest features are a vertex and a face, or two edges.
//
// Cost: a face is looked at only if the other body's inner ball leaves it a chance, an edge only if it comes within the
// depth of the other body, for both ends of the shortest way out are that near to one another.
//
// Parallel edges (sine below 1e-12) span nothing: the faces beside them give the normal. Equal axes: the first, faces
// of a, of b, edges. Nearly parallel ones: the cross product is made perpendicular to the edge of a once more, so that
// its round-off does not tilt it along the edge.
#pragma once

#include "contact/polyhedra/placed.hpp"
#include "contact/polyhedra/scratch.hpp"

namespace scree::contact {

struct SeparatingAxis {
    enum class Kind : std::uint8_t { centres, face_of_a, face_of_b, edges };
    Vec3 normal;        // unit, from b to a
    double separation;  // [m] s
    Kind kind;
    std::uint32_t feature_a, feature_b;  // faces or edges
};

SeparatingAxis separating_axis(const Placed& a, const Placed& b, PolyhedraScratch& scratch);

}  // namespace scree::contact
