// What may be wrong with a scene that is formally right: bodies that overlap at the start, a time step too long for the
// speeds and sizes. One sentence each, for `check` and for the start of a run.
#pragma once

#include <string>
#include <vector>

#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::app {

std::vector<std::string> scene_warnings(const Scene& scene, const State& state);

// The parts of it.
std::vector<std::string> overlap_warnings(const Scene& scene, const State& state);
std::vector<std::string> step_warnings(const Scene& scene, const State& state);

}  // namespace scree::app
