// The point nearest to the origin of the Minkowski difference { x - y : x in a, y in b } of two convex polyhedra, by
// the algorithm of Gilbert, Johnson and Keerthi (1988); the regions of a simplex as in Ericson (2005, 5.1, 9.5).
//
//   v = x - y, |v| = distance;  a simplex of at most four support points w(v) = s_a(-v) - s_b(v) comes nearer to the
//   origin in each turn, until no support point lies nearer:  |v|^2 - v . w(v) <= round-off
//
// For every v, v . w(v) / |v| is a lower bound of the distance: bodies farther apart than the margin leave early.
#pragma once

#include <array>

#include "contact/polyhedra/placed.hpp"

namespace scree::contact {

enum class Nearness : std::uint8_t {
    far,         // farther apart than the margin; v is a direction that shows it
    near,        // apart by |v|
    overlapping  // or nearly so; separating_axis.hpp knows
};

struct ClosestPoints {
    Nearness nearness;
    Vec3 v;                                   // [m] from b to a, a point of the difference: |v| is no less than the gap
    double bound;                             // [m] the gap is no less than that
    int corners;                              // of the last simplex, the hull of which holds v
    std::array<std::uint32_t, 3> on_a, on_b;  // their vertices
};

ClosestPoints closest_points(const Placed& a, const Placed& b, double margin);

}  // namespace scree::contact
