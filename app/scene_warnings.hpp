// What may be wrong with a scene that is formally right: bodies that overlap at the start, a time step too long for the
// speeds and sizes. One sentence each, for `check` and for the start of a run. All functions are collective; the
// sentences are those of rank 0.
#pragma once

#include <string>
#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::app {

std::vector<std::string> scene_warnings(const Scene& scene, const State& state,
                                        const Communicator& ranks = Communicator::self());

// The parts of it.
std::vector<std::string> overlap_warnings(const Scene& scene, const State& state, const Communicator& ranks);
std::vector<std::string> step_warnings(const Scene& scene, const State& state, const Communicator& ranks);

}  // namespace scree::app
