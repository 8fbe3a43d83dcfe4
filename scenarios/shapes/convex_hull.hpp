// The convex hull of points, as a shape. By CGAL's quickhull with exact predicates: no point is judged wrongly by
// round-off, so that there is a hull of any points that are not all in one plane.
//
// The faces that a contact needs are then found by a tolerance: points closer than it are one, neighbouring triangles
// that lie in one plane up to it are one face.
#pragma once

#include <vector>

#include "core/make_shape.hpp"

namespace scree::scenarios {

// Relative to the size (the diagonal of the points' box). Why 1e-8: coordinates in text have nine digits or more
// (5e-10), and points computed 10^6 sizes away are wrong by 1e-10, so that what was plane is found plane; a contact
// feels an overlap of 1e-4. Coordinates in single precision (6e-8) need 1e-6.
inline constexpr double kHullTolerance = 1e-8;
inline constexpr double kSinglePrecisionTolerance = 1e-6;

// Fewer than 4 different points, points in one line or plane up to the tolerance, or a coordinate that is not finite,
// are a ShapeError. The order of the points does not matter: the same set gives the same bits.
PlacedShape convex_hull(const std::vector<Vec3>& points, double tolerance = kHullTolerance);

}  // namespace scree::scenarios
