// Walls, their motion and their life time.
#pragma once

#include "core/scene.hpp"
#include "scenarios/context.hpp"
#include "scenarios/terrain.hpp"

namespace scree::scenarios {

// `terrains`: those of the walls that are terrain, in their order.
void build_walls(const io::Node& scenario, const Context& context, std::vector<TerrainFile> terrains, Scene& scene);

// Errors at walls that cannot hold polyhedra.
void check_walls_of_polyhedra(const io::Node& scenario, const Scene& scene, const Context& context);

}  // namespace scree::scenarios
