// The run loop: from the state as it stands to the end of the scenario, or until something asks it to stop.
#pragma once

#include <string>

#include "app/output_schedule.hpp"
#include "app/progress.hpp"
#include "app/run_output.hpp"
#include "app/stop_request.hpp"
#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "solvers/measures.hpp"
#include "solvers/stepper.hpp"

namespace scree::app {

// Everything that the loop works on. Only `state` is kept by a checkpoint.
struct RunContext {
    const Scene& scene;
    State& state;
    solvers::Stepper& stepper;
    solvers::Measures& measures;
    RunOutput& output;
    Progress& progress;
    StopRequest& stop;
    OutputSchedule schedule;
};

struct RunEnd {
    bool complete = false;
    std::string reason;  // why it stopped early
    StepReport last;     // of the last step; empty if none was made
};

// Both ways of ending leave a checkpoint. Throws PhysicsError and IoError: then the earlier checkpoints stand.
RunEnd run_loop(RunContext& run);

}  // namespace scree::app
