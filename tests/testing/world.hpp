// A small scene that steps.
#pragma once

#include <memory>

#include "core/plan.hpp"
#include "solvers/energy.hpp"
#include "solvers/stepper.hpp"
#include "tests/testing/small_scene.hpp"

namespace scree::testing {

struct World : SmallScene {
    Plan plan;
    std::unique_ptr<solvers::Stepper> stepper;
    StepReport report;  // of the last step

    using SmallScene::SmallScene;
    World(World&&) = delete;  // the stepper refers to the scene and to the plan

    // After the scene is complete.
    void start() {
        plan = make_plan(scene, state.bodies);
        if (plan.spin) state.bodies.spin = given_spins;
        state.inlets.resize(scene.inlets.size());
        state.outlets.resize(scene.outlets.size());
        state.measures.resize(scene.measures.size());
        solvers::start_ledger(scene, state);
        stepper = std::make_unique<solvers::Stepper>(scene, plan);
    }
    const StepReport& step() {
        if (!stepper) start();
        report = stepper->advance(state);
        return report;
    }
    void run(int steps) {
        for (int k = 0; k < steps; ++k) step();
    }
};

}  // namespace scree::testing
