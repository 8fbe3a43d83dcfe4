// A pair of polyhedra met for the first time, with room of its own.
#pragma once

#include "contact/polyhedra/polyhedron_polyhedron.hpp"

namespace scree::testing {

inline contact::Manifold touch(const contact::Placed& a, const contact::Placed& b, double margin) {
    contact::PolyhedraScratch scratch;
    contact::Manifold found;
    Vec3 axis = Vec3::Zero();
    contact::polyhedron_polyhedron(a, b, margin, axis, scratch, found);
    return found;
}

inline Quat about(const Vec3& axis, double angle) {
    return Quat(Eigen::AngleAxisd(angle, axis.normalized()));
}

}  // namespace scree::testing
