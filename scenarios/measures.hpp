// Measures: what the scenario asks to be measured. Needs scene.walls and scene.time.
#pragma once

#include "core/scene.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

void build_measures(const io::Node& scenario, const Context& context, Scene& scene);

// Polyhedra are measured in regions with flat sides alone.
void check_measures_of_polyhedra(const io::Node& scenario, const Context& context);

}  // namespace scree::scenarios
