// Bodies that come (inlets) and go (outlets), at the end of a scenario step.
#pragma once

#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::solvers {

// Removes the bodies in the outlets' regions; mass and energy are accounted for. Returns whether any went.
bool take_bodies(const Scene& scene, State& state);
// Makes the bodies that the inlets owe by now, at free random places. Returns whether any came.
bool make_bodies(const Scene& scene, const Plan& plan, State& state);

}  // namespace scree::solvers
