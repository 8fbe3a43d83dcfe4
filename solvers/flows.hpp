// Bodies that come (inlets) and go (outlets), at the end of a scenario step. Collective: all ranks take and make the
// same bodies, with the same numbers in the state, whichever rank has which.
#pragma once

#include "core/parallel/communicator.hpp"
#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::solvers {

// Removes the bodies in the outlets' regions, ghosts too; mass and energy are accounted for. Returns whether any went
// from any rank.
bool take_bodies(const Scene& scene, State& state, const Communicator& ranks = Communicator::self());
// Makes the bodies that the inlets owe by now, at free random places, on rank 0. Ghosts need not be there, but those
// that are must be where their bodies are. Returns whether any came.
bool make_bodies(const Scene& scene, const Plan& plan, State& state, const Communicator& ranks = Communicator::self());

}  // namespace scree::solvers
