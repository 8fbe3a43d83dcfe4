// Bodies that a scenario follows: which, and a row of their numbers. A row is equal on all ranks.
#pragma once

#include <cstdint>
#include <vector>

#include "core/measure.hpp"
#include "core/parallel/communicator.hpp"
#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::solvers {

// Ids, increasing: those that are named, or so many of all that are there. Collective.
std::vector<std::uint64_t> choose_followed(const TrajectorySettings& settings, const Bodies& bodies,
                                           const Communicator& ranks);

// time; then of each body ID.position, ID.velocity, and ID.spin and ID.orientation (w, x, y, z) if the plan has them.
std::vector<HistoryColumn> trajectory_columns(const State& state, const Plan& plan);
// In the order of the columns; NaN for a body that is not there. Collective.
std::vector<double> trajectory_row(const Scene& scene, const State& state, const Plan& plan, const Communicator& ranks);

}  // namespace scree::solvers
