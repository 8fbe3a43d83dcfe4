// Walls, their motion and their life time.
#pragma once

#include "core/scene.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

void build_walls(const io::Node& scenario, const Context& context, Scene& scene);

}  // namespace scree::scenarios
