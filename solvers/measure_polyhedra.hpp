// How far bodies of any shape reach along an axis, and which part of them lies in a region.
//
// Volume of a polyhedron below up to three planes at right angles: by the divergence theorem about the point o where
// the planes meet, so that the parts of the planes themselves give nothing,
//   V = (1/3) sum over faces of n . (x - o) A,   A: area of the face below the planes
// A box is the difference of eight such corners, to 1e-15 of the polyhedron's volume.
#pragma once

#include "core/region.hpp"
#include "core/state.hpp"

namespace scree::solvers::detail {

struct Reach {
    double low, high;  // [m] along the axis
};
Reach reach_of(const State& state, std::size_t body, const Vec3& axis);

double volume_of(const State& state, std::size_t body);  // [m3]
// The part of a body in a region [m3]; of a polyhedron in a box or a half-space.
double part_in(const Region& region, const State& state, std::size_t body);
// The part between two coordinates along a unit axis [m3].
double part_between(const State& state, std::size_t body, const Vec3& axis, double low, double high);

}  // namespace scree::solvers::detail
