// Overlaps of the bodies as they stand, for `check` and for a warning at the start.
#pragma once

#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::solvers {

struct Overlap {
    ContactKey key;
    double depth;  // [m]
    Vec3 point;
};
// With each other and with the walls present at state.time: deeper than `relative` of the smaller radius. Bodies lie on
// any ranks; each overlap is found by the one that would solve its contact. Collective.
std::vector<Overlap> find_overlaps(const Scene& scene, const State& state, double relative,
                                   const Communicator& ranks = Communicator::self());

}  // namespace scree::solvers
