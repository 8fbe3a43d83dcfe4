// Materials and the laws of their pairs. A pair that is not listed takes the smaller friction and the smaller
// restitution of its two materials; a listed pair without a number the smaller friction and the mean restitution.
#pragma once

#include "core/scene.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

// Fills scene.materials, scene.pairs and context.materials.
void build_materials(const io::Node& scenario, Context& context, Scene& scene);

}  // namespace scree::scenarios
