// Rasters and trajectories: what the scenario asks to be kept of flow and bodies. Needs scene.walls and scene.time.
#pragma once

#include "core/scene.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

void build_rasters(const io::Node& scenario, const Context& context, Scene& scene);
void build_trajectories(const io::Node& scenario, Scene& scene);

}  // namespace scree::scenarios
