// A convex body cut in two by a plane.
//
// Which side a corner is on is the sign of its distance; then the corners of each side are made to hang together along
// edges, which for a convex body is true but for round-off. From there on all is combinatorics: every face is crossed
// on two edges or none, and the parts are closed bodies whatever the numbers are. Both have the same new corners, so
// that their volumes add up to the body's but for round-off. Where the plane passes a corner closely, parts have very
// short edges; make_shape makes them vanish.
#pragma once

#include "core/polyhedron.hpp"

namespace scree::scenarios {

struct CutPlane {
    Vec3 normal;    // unit
    double offset;  // [m] normal . x on the plane
};

// On the side that the normal points away from, and on the other. Without faces where there is no such part.
struct CutParts {
    Polyhedron below, above;
};

// A part that reaches less than `thickness` [m] across the plane is not cut off: the other one is the whole body.
CutParts cut(const Polyhedron& body, const CutPlane& plane, double thickness);
// The part below only.
Polyhedron cut_below(const Polyhedron& body, const CutPlane& plane, double thickness);

}  // namespace scree::scenarios
