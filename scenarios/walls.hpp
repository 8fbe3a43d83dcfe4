// Walls, their motion and their life time.
#pragma once

#include "core/scene.hpp"
#include "scenarios/context.hpp"
#include "scenarios/terrain.hpp"

namespace scree::scenarios {

// `terrains`: those of the walls that are terrain, in their order.
void build_walls(const io::Node& scenario, const Context& context, std::vector<TerrainFile> terrains, Scene& scene);

}  // namespace scree::scenarios
