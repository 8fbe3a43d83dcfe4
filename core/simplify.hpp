// Vertices closer than a tolerance become one, and neighbouring faces in one plane become one face, so that a cube of
// noisy triangles is a cube of six faces. Contacts need this: a face cut into triangles has edges that are none.
#pragma once

#include "core/polyhedron.hpp"

namespace scree {

// `tolerance` [m] is the length of the longest edge that vanishes, and how far corners of a merged face may lie out of
// its plane. The surface moves by about that much, nowhere more than a few times that. `body`: closed and oriented
// (edges_of). Faces stay as they are
// where there is nothing to merge. What vanishes altogether is a ShapeError.
void simplify(Polyhedron& body, double tolerance);

}  // namespace scree
