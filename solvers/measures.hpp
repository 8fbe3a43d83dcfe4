// Evaluates the measures of a scene (core/measure.hpp) after a step, for the history and the summary.
//
// Means over a measure's window [from, until]:
//   flow_rate                             what passed inside the window / the time of it: exact, not a mean of rates
//   mass_in, wall_force, extent           weighted by time, over every scenario step; a step that the window cuts
//   counts
//                                         with the part that lies inside
//   coordination, packing_fraction,       of samples at the rows of the history and at the end of the window, each
//   weighted profile                               by the time since the one before
// What follows is collective, and every rank gets the same numbers: each counts the bodies and contacts that are its
// own. Lengths in columns are absolute (the scene's origin is added); torques are about the scene's origin.
#pragma once

#include <string>
#include <vector>

#include "core/measure.hpp"
#include "core/parallel/communicator.hpp"
#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "solvers/pool.hpp"
#include "solvers/stepper.hpp"

namespace scree::solvers {

// Columns that every run has: time, bodies, mass, contacts, active_contacts, sweeps, residual_rms, residual_max,
// penetration_max, penetration_mean, penetration_max_relative, penetration_mean_relative, kinetic_energy,
// potential_energy, work.<law>, energy_imbalance, momentum_error, max_speed; then those of the measures, named
// "<measure>.<quantity>".
std::vector<HistoryColumn> history_columns(const Scene& scene);

// What the measures read of the last scenario step beside the state.
struct StepOutcome {
    const std::vector<ContactRecord>& contacts;
    const std::vector<WallLoad>& wall_loads;
    double length;  // [s]
};
inline StepOutcome outcome_of(const Stepper& stepper) {
    return {stepper.contacts(), stepper.wall_loads(), stepper.last_step()};
}

// This rank's own bodies at the start of a step, as far as flow rates need them.
struct StartOfStep {
    double time = 0.0;  // [s]
    std::vector<BodyId> id;
    std::vector<double> mass;    // [kg]
    std::vector<Vec3> position;  // [m]
    std::vector<Vec3> velocity;  // [m/s]
};

class Measures {
  public:
    explicit Measures(const Scene& scene, const Communicator& ranks = Communicator::self());

    // Call before Stepper::advance. Nothing is stored if no measure needs it.
    void before_step(const State& state);
    // Call after Stepper::advance, once a scenario step: updates state.measures (what passed, sums over windows).
    // Returns at once in a scene without measures.
    void after_step(const Scene& scene, State& state, const Stepper& stepper, const StepReport&) {
        if (!scene.measures.empty()) after_step(scene, state, outcome_of(stepper));
    }
    void after_step(const Scene& scene, State& state, const StepOutcome& outcome);

    // One row of the history in the order of history_columns (a profile takes several numbers). Resets what counts
    // since the last row. Before the first step, pass a StepReport{} with the numbers of bodies.
    std::vector<double> row(const Scene& scene, State& state, const Stepper& stepper, const StepReport& report) {
        return row(scene, state, outcome_of(stepper), report);
    }
    std::vector<double> row(const Scene& scene, State& state, const StepOutcome& outcome, const StepReport& report);

    // Means over each measure's window, for the summary. Measures whose window holds no time of the run so far are left
    // out.
    struct Mean {
        std::string column, unit;
        std::vector<double> value;
        double from, until, covered;  // [s] window asked for, and time covered by it
    };
    static std::vector<Mean> means(const Scene& scene, const State& state);

  private:
    const Communicator& ranks_;
    StartOfStep start_;
    bool counts_passages_ = false;
    Pool pool_;  // scratch
    std::vector<double> numbers_;
};

}  // namespace scree::solvers
