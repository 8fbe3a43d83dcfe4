// The end of a run in words: warnings that a user should not miss, and the short summary on standard output.
#pragma once

#include <string>
#include <vector>

#include "app/run_loop.hpp"
#include "core/plan.hpp"
#include "io/results/summary.hpp"

namespace scree::app {

// What went less well than asked for: one sentence each.
std::vector<std::string> run_warnings(const Scene& scene, const State& state);

// `warnings`: of the whole run. status: complete, stopped_early or failed.
// Collective; whole on rank 0.
io::Summary make_summary(const Scene& scene, const Plan& plan, const State& state, const RunOutput& output,
                         const StepReport& last, const std::string& status, const std::string& reason,
                         std::vector<std::string> warnings, const Communicator& ranks);

// For a person, about 15 lines. `all`: the ranks.
std::string summary_text(const io::Summary& summary, const Scene& scene, const RunFolder& folder,
                         const std::vector<RankFigures>& all);

}  // namespace scree::app
