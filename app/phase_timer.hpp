// Adds the wall time of a block to one phase of the run's totals.
#pragma once

#include <chrono>

#include "core/step_report.hpp"

namespace scree::app {

class PhaseTimer {
  public:
    PhaseTimer(RunTotals& totals, Phase phase)
        : seconds_(totals.wall_by_phase[static_cast<std::size_t>(phase)]), start_(Clock::now()) {}
    ~PhaseTimer() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
    PhaseTimer(const PhaseTimer&) = delete;
    PhaseTimer& operator=(const PhaseTimer&) = delete;

  private:
    using Clock = std::chrono::steady_clock;
    double& seconds_;
    Clock::time_point start_;
};

}  // namespace scree::app
