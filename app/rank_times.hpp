// What each rank of a run did: the time of its phases, what it waited for, what it holds. Phases are timed on each rank
// (state.totals.wall_by_phase while a run goes on); files show the mean over ranks, and this the single ranks.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/state.hpp"
#include "io/results/run_log.hpp"
#include "solvers/rank_report.hpp"

namespace scree::app {

using PhaseTimes = std::array<double, kPhaseCount>;  // [s]

struct RankFigures {
    PhaseTimes phase{};  // [s] in this part of the run
    solvers::RankReport report;

    double steps() const;  // [s] in time steps: all phases but measures and output
    double work() const { return steps() - report.wait_seconds; }  // [s]
};

// Of all ranks, on rank 0 (elsewhere empty). Collective.
std::vector<RankFigures> gather(const RankFigures& own, const Communicator& ranks);

// Largest over the mean; 1 for nothing at all.
double imbalance(const std::vector<double>& values);

class RankTimes {
  public:
    // `state` as the run starts or goes on: its times are those of earlier parts, the same on all ranks.
    RankTimes(const State& state, const Communicator& ranks);

    RankFigures figures(const State& state, const solvers::RankReport& report) const;
    // Of all parts of the run, mean over ranks. Collective.
    PhaseTimes mean(const State& state) const;
    // What happened since the last call, on rank 0. Collective.
    io::RankLoads loads(const State& state, const solvers::RankReport& report);

  private:
    const Communicator& ranks_;
    PhaseTimes before_;
    double work_logged_ = 0.0, wait_logged_ = 0.0;  // [s]
};

// The section `ranks` of summary.yaml.
std::string ranks_section(const std::vector<RankFigures>& all);
// The same in a line for people; "" for one rank.
std::string ranks_line(const std::vector<RankFigures>& all);

}  // namespace scree::app
