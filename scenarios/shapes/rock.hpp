// A random rock: the hull of points on an ellipsoid.
//
// Length L, breadth I and thickness S are the sides of the box around the rock along the axes of the ellipsoid (x, y, z
// of the given frame). Their ratios are the rock's form (Zingg 1935): elongation I/L and flatness S/I, each in (0, 1];
// they are met exactly, since the points are stretched to them last. The fewer points, the more angular; the mean
// volume of many is that of the ellipsoid, pi/6 L I S, and with n points about a share 1 - 12/n less.
#pragma once

#include <cstdint>

#include "core/make_shape.hpp"
#include "core/random.hpp"

namespace scree::scenarios {

struct RockForm {
    int points;         // >= 6; all of them become corners. 8 to 15 angular, 100 well rounded
    double elongation;  // I/L
    double flatness;    // S/I
};

// With L = 1 m (solids.hpp: with_volume). A function of the form and the draws alone; points are spread over the
// ellipsoid by taking the best of several candidates (Mitchell 1991), so that faces are of like size.
PlacedShape random_rock(const RockForm& form, Random random);

}  // namespace scree::scenarios
