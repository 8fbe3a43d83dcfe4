// Volume, centre of mass and second moments of a polyhedron of density 1, by the divergence theorem: the sum over the
// tetrahedra between the origin and the triangles (a, b, c) that the faces fall into, with D = a . (b x c),
//   V = sum D / 6,   V c = sum D (a + b + c) / 24,
//   C = int x x^T dV = sum D (a a^T + b b^T + c c^T + s s^T) / 120,   s = a + b + c
// (the same numbers as Mirtich 1996, Fast and accurate computation of polyhedral mass properties, J. Graphics Tools 1).
// The nearer the origin is to the body, the less is lost to cancellation.
#pragma once

#include "core/polyhedron.hpp"

namespace scree {

struct VolumeIntegrals {
    double volume;  // V [m3]
    Vec3 centre;    // c [m]
    Mat3 second;    // C - V c c^T [m5]: about the centre
    double area;    // [m2]
};
VolumeIntegrals volume_integrals(const Polyhedron& body);

// Eigenvectors (columns) of a symmetric positive matrix by Jacobi's rotations, each axis next to the unit vector it
// turned from. Entries beside the diagonal below `noise` times the largest on it are zero: equal moments leave axes as
// they are.
Mat3 principal_axes(const Mat3& second, double noise);

}  // namespace scree
