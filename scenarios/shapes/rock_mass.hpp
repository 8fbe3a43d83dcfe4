// A rock mass: a convex body cut through by sets of parallel joints into blocks that fill it exactly.
//
// Dip and dip direction as in the field: the angle of steepest descent below the horizontal, and its azimuth clockwise
// from north. x is east, y north, z up, so the upward normal is (sin dip sin direction, sin dip cos direction, cos
// dip).
#pragma once

#include <cstdint>
#include <vector>

#include "core/make_shape.hpp"

namespace scree::scenarios {

struct JointSet {
    double dip;              // [rad] 0 to pi/2
    double dip_direction;    // [rad]
    double spacing;          // [m] mean distance along the normal
    double spacing_scatter;  // in [0, 1): distances are uniform in spacing (1 +- scatter)
    double angle_scatter;    // [rad] standard deviation of the normal, in each of two directions, 0 to 0.3
};

struct RockMass {
    std::vector<PlacedShape> blocks;  // sorted by nothing: the order in which joints made them
    double volume = 0.0;              // [m3] of the body
    // Slivers too thin to be bodies, of less than 1e-9 of the size of the mass: left out. Their number and volume [m3].
    std::size_t slivers = 0;
    double lost = 0.0;
};

// Joints run through the whole mass. The first one of a set lies at random within one spacing of the middle; joint k to
// either side is a function of (seed, set, k) alone. `seed` should be the mass's own (mix64 of the scenario's seed and
// its generator's number). More than `most` blocks are refused, before memory is.
RockMass cut_rock_mass(const Polyhedron& body, const std::vector<JointSet>& sets, std::uint64_t seed,
                       std::size_t most = 10'000'000);

Vec3 upward_normal(double dip, double dip_direction);

}  // namespace scree::scenarios
