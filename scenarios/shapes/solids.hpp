// Solids in closed form. Each stands with its centre of mass at the origin of its own frame, described here; the
// placement says how the body frame lies in it.
#pragma once

#include "core/make_shape.hpp"

namespace scree::scenarios {

// Edges of the lengths `size` [m] along x, y, z.
PlacedShape box(const Vec3& size);

// A regular prism along z with `sides` >= 3: `diameter` [m] of the circle around its section (one corner on the x
// axis), and `length` [m].
PlacedShape prism(int sides, double diameter, double length);

enum class Platonic { tetrahedron, cube, octahedron, dodecahedron, icosahedron };
// With edges of the length `edge` [m].
PlacedShape platonic(Platonic solid, double edge);

// The block that rockfall barriers are tested with (EOTA 2013, ETAG 027): a cube of edge L with its twelve edges cut
// off, corners at all permutations of (+-L/2, +-L/4, +-L/4): 24 corners, 26 faces, 17/24 L^3. Stretched to `sides` [m]
// along x, y, z it is the family of Caviezel et al. (2021, Nat. Commun. 12:5546): (1, 1, 1) L is EOTA 111, (2, 2, 1) L
// the plate EOTA 221.
PlacedShape eota_block(const Vec3& sides);

// The box between two corners [m], to be cut.
Polyhedron box_between(const Vec3& lower, const Vec3& upper);

// The same solid, made larger or smaller about the origin of its frame to have a volume [m3].
PlacedShape with_volume(PlacedShape placed, double volume);
// Volume of the ball of a diameter: the size of a body is given by its equivalent diameter.
double ball_volume(double diameter);

}  // namespace scree::scenarios
