// Voronoi cells: what lies nearer to a seed than to any other, inside a convex body. Each is the body cut by the planes
// halfway to the other seeds, the nearest first, until none can reach it: the planes that are left are farther away
// than twice the cell's farthest corner (Rycroft 2009, Voro++, Chaos 19).
#pragma once

#include <vector>

#include "core/polyhedron.hpp"

namespace scree::scenarios {

// One cell a seed, in the same order. Together they fill the body: volumes add up but for round-off and parts cut off
// that would be thinner than 1e-9 of its size. A seed outside of the body, or two closer than 1e-6 of its size, are a
// ShapeError.
std::vector<Polyhedron> voronoi_cells(const Polyhedron& body, const std::vector<Vec3>& seeds);

}  // namespace scree::scenarios
