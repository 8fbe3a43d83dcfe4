// Overlaps of the bodies as they stand, for `check` and for a warning at the start.
#pragma once

#include <vector>

#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::solvers {

struct Overlap {
    ContactKey key;
    double depth;  // [m]
    Vec3 point;
};
// With each other and with the walls present at state.time: deeper than `relative` of the smaller radius. An overlap is
// found on the rank that has the body key.a; one with a body of another rank is found if that one is here as a ghost.
std::vector<Overlap> find_overlaps(const Scene& scene, const State& state, double relative);

}  // namespace scree::solvers
