// Evaluates the measures of a scene (core/measure.hpp) after a step, for the history and the summary.
#pragma once

#include <string>
#include <vector>

#include "core/measure.hpp"
#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "solvers/stepper.hpp"

namespace scree::solvers {

// Columns that every run has: time, bodies, contacts, sweeps, residual_rms, residual_max, penetration_max,
// penetration_mean, kinetic_energy, potential_energy, work.<law>, energy_imbalance, momentum_error, total mass, ...
// and then those of the measures, named "<measure>.<quantity>".
std::vector<HistoryColumn> history_columns(const Scene& scene);

// After each step, before bodies are taken away: what passed the surfaces of the flow-rate measures in this step.
// `before` are the positions at the start of the step, in the order of state.bodies.
// (The stepper calls no measure: the run loop does.)
class Measures {
  public:
    explicit Measures(const Scene& scene);

    // Call once a scenario step, after Stepper::advance: updates state.measures (passed mass, window sums).
    // `previous_position` / `previous_id`: bodies at the start of the step.
    void after_step(const Scene& scene, State& state, const Stepper& stepper, const StepReport& report);
    // Call at the start of a step: remembers what flow-rate measures need. Nothing is stored if no measure needs it.
    void before_step(const State& state);

    // One row of the history in the order of history_columns (profiles take several numbers). Resets the numbers that
    // count since the last row.
    std::vector<double> row(const Scene& scene, State& state, const Stepper& stepper, const StepReport& report);

    // Means over each measure's window, for the summary: name, unit, values (one a number of the measure's columns).
    struct Mean {
        std::string column, unit;
        std::vector<double> value;
        double from, until, covered;  // [s] window asked for, and time covered by it
    };
    static std::vector<Mean> means(const Scene& scene, const State& state);

  private:
    std::vector<BodyId> previous_id_;
    std::vector<Vec3> previous_position_;
    bool needs_previous_ = false;
};

}  // namespace scree::solvers
