// The shapes that a scenario names, from its list `shapes`. Every rank makes all of them, the same bits; of mesh files
// rank 0 reads the bytes and tells the others.
#pragma once

#include "core/parallel/communicator.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

// Fills context.shapes. A shape that cannot be is reported at its item, one that makes trouble (a needle, a plate, an
// edge of a millionth of its size) is warned of.
void build_shapes(const io::Node& scenario, const Communicator& ranks, Context& context);

// The shape with its frame's points multiplied by `factor`.
PlacedShape scaled(PlacedShape placed, double factor);
// Diameter of the ball of equal volume [m].
double equivalent_diameter(const ConvexShape& shape);
// A shape with more edges than contacts can name is a ShapeError.
void check_features(const ConvexShape& shape);
// What is wrong with a shape that can be: "is a needle, ..."; empty: nothing.
std::string trouble_with(const ConvexShape& shape);

}  // namespace scree::scenarios
