// Where a surface of triangles ends: its border, and upright triangles that go on from it.
#pragma once

#include <vector>

#include "core/terrain_lookup.hpp"
#include "core/vec.hpp"

namespace scree {

// A vertex at which parts of the surface meet that have no edge in common there becomes one vertex a part, so that the
// border passes each vertex once.
void split_pinches(std::vector<Vec3>& vertex, std::vector<TriangleCorners>& triangle);

// Adds two upright triangles at each edge of the border, from it to the height `z` [m]: below the surface they face
// away from it, above it inwards.
void add_sides(std::vector<Vec3>& vertex, std::vector<TriangleCorners>& triangle, double z);

}  // namespace scree
