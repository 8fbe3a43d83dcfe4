// Polyhedra for tests, as vertices and loops.
#pragma once

#include "core/polyhedron.hpp"

namespace scree::testing {

// About the origin.
inline Polyhedron box(const Vec3& sides) {
    Polyhedron body;
    for (int i = 0; i < 8; ++i)
        body.vertex.push_back(0.5 *
                              sides.cwiseProduct(Vec3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0)));
    body.face = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return body;
}
inline Polyhedron cube(double side) {
    return box(Vec3::Constant(side));
}

// A box of sides 2 about the origin whose vertices go to f(vertex): any hexahedron. f keeps right hands right.
template <class Map>
Polyhedron hexahedron(const Map& f) {
    Polyhedron body = cube(2.0);
    for (Vec3& v : body.vertex) v = f(v);
    return body;
}

}  // namespace scree::testing
