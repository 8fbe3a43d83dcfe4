// Measures: what the scenario asks to be measured. Needs scene.walls and scene.time.
#pragma once

#include "core/scene.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

void build_measures(const io::Node& scenario, const Context& context, Scene& scene);

}  // namespace scree::scenarios
