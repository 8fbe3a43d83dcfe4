// From a polyhedron in any frame to a shape in its body frame, checked: closed, oriented, planar faces, convex, with a
// volume.
//
// The axes of the body frame are the principal axes by increasing moment of inertia, right-handed. Which way they point
// is chosen so that the first two have their largest component (the first of those that are nearly the largest) along
// the positive axis of the given frame; among equal moments the order and the axes of the given frame are kept as far
// as they can be, so that a cube or a box along the axes is not turned by round-off.
#pragma once

#include "core/polyhedron.hpp"

namespace scree {

struct PlacedShape {
    ConvexShape shape;
    Vec3 centre;    // of mass [m], in the frame of the polyhedron
    Quat rotation;  // from the body frame: x = centre + rotation * x_body
};

// Tolerances are relative to the size (the diagonal of the box along the axes that holds the body). Why 1e-9: far above
// what double precision does to coordinates near the body (1e-16), far below what a contact can feel (overlaps of
// 1e-4). Coordinates so far away that they carry fewer digits widen it by 4 of their last digits: 1e-9 at 10^6 sizes.
inline constexpr double kShapeTolerance = 1e-9;

// Edges shorter than the tolerance vanish, neighbouring faces in one plane are merged (simplify.hpp); corners may lie
// out of the plane of their face by 4 tolerances, and vertices above the plane of another face. A body thinner than
// that has no volume. Anything else is a ShapeError with numbers in its message.
PlacedShape make_shape(const Polyhedron& body, double tolerance = kShapeTolerance);

// The shape's vertices and faces, where it was.
Polyhedron polyhedron_of(const PlacedShape& placed);
// The same shape, `factor` times as large: V f^3, J f^5.
ConvexShape scaled(ConvexShape shape, double factor);

}  // namespace scree
