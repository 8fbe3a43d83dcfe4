// Inlets and outlets.
#pragma once

#include "core/scene.hpp"
#include "scenarios/context.hpp"

namespace scree::scenarios {

void build_inlets(const io::Node& scenario, const Context& context, Scene& scene);
void build_outlets(const io::Node& scenario, const Context& context, Scene& scene);

}  // namespace scree::scenarios
