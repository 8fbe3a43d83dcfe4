// Time, gravity, solver, correction and output: what holds for the run as a whole.
#pragma once

#include "core/scene.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

void build_settings(const io::Node& scenario, const Context& context, Scene& scene);

}  // namespace scree::scenarios
