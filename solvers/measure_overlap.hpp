// Volume of a sphere that lies in a region [m3].
//   half-space, slab:  caps, pi k^2 (3 r - k) / 3 for height k
//   sphere:            the lens of two spheres
//   box, cylinder:     caps where faces of one direction cut; else the integral along one axis of the exact area that
//   the
//                      sphere's circle shares with the rectangle or the circle, over pieces between the places where
//                      the area's formula changes, to 1e-13 of the sphere's volume
#pragma once

#include "core/region.hpp"

namespace scree::solvers {

double overlap_volume(const Region& region, const Vec3& centre, double radius);

// The part of a sphere of this radius about 0 between `low` and `high` on an axis [m3].
double slab_volume(double radius, double low, double high);

// Areas in units of the length's square, for a circle of radius `rho` about the origin.
double quadrant_area(double rho, double a, double b);          // with x >= a and y >= b
double lens_area(double rho, double radius, double distance);  // with another circle

}  // namespace scree::solvers
