// What a run starts from: a scenario, or a checkpoint and the scenario that it holds.
#pragma once

#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/run_folder.hpp"
#include "core/parallel/communicator.hpp"
#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "io/results/provenance.hpp"

namespace scree::app {

struct RunSetup {
    Scene scene;
    State state;  // of the bodies and impulses this rank's
    io::Provenance provenance;
    bool resumed = false;
    std::vector<std::string> warnings;  // about the scene and the files it came from
    std::string scenario_warnings{};    // about the scenario's text, with source lines
};

// Reads and checks everything; then makes (or opens) and locks the folder. Nothing is written before the scenario is
// valid. Collective; rank 0 holds the folder for all.
RunSetup set_up_run(const RunOptions& options, RunFolder& folder, const Communicator& ranks);

}  // namespace scree::app
