// The run loop: from the state as it stands to the end of the scenario, or until something asks it to stop. All ranks
// go through it together. What a clock decides (is a checkpoint due?) and what any rank noticed (a signal) all ranks
// learn after each step.
#pragma once

#include <string>

#include "app/output_schedule.hpp"
#include "app/progress.hpp"
#include "app/rank_times.hpp"
#include "app/run_output.hpp"
#include "app/stop_request.hpp"
#include "core/parallel/communicator.hpp"
#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "solvers/measures.hpp"
#include "solvers/rasters.hpp"
#include "solvers/stepper.hpp"
#include "solvers/trajectories.hpp"

namespace scree::app {

// Everything that the loop works on. Only `state` is kept by a checkpoint.
struct RunContext {
    const Scene& scene;
    const Plan& plan;
    State& state;
    solvers::Stepper& stepper;
    solvers::Measures& measures;
    solvers::Rasters& rasters;
    RunOutput& output;
    Progress& progress;
    StopRequest& stop;
    RankTimes& times;
    OutputSchedule schedule;
    const Communicator& ranks;
};

struct RunEnd {
    bool complete = false;
    std::string reason;  // why it stopped early
    StepReport last;     // of the last step; empty if none was made
};

// Both ways of ending leave a checkpoint. Throws PhysicsError and IoError: then the earlier checkpoints stand.
RunEnd run_loop(RunContext& run);

}  // namespace scree::app
