// From a scenario file (or the text that a checkpoint holds) and --set to a checked tree, for `run` and `check`.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "io/scenario/diagnostics.hpp"
#include "io/scenario/scenario_node.hpp"

namespace scree::app {

struct LoadedScenario {
    io::Node root;
    std::string name;                              // the file as given
    std::string text;                              // as read
    std::string resolved;                          // YAML with every default and override
    std::string folder;                            // relative paths in the scenario start here
    std::shared_ptr<io::Diagnostics> diagnostics;  // knows the source lines; collects the warnings
};

// Throw ScenarioError with all faults at once. Rank 0 reads the file and what it includes, the others are told.
LoadedScenario load_scenario(const std::string& path, const std::vector<std::string>& sets,
                             const Communicator& ranks = Communicator::self());
// `resolved` as another run wrote it; `name` for messages.
LoadedScenario load_resolved(const std::string& resolved, const std::string& name,
                             const std::vector<std::string>& sets);

// `path` without its last part; "." if it has one part only.
std::string folder_of(const std::string& path);

struct BuiltScenario {
    Scene scene;
    State state;                            // at time 0, ledger started; of the bodies this rank's
    std::vector<std::string> shape_name{};  // of each of state.shapes: what it was made from
};
BuiltScenario build_scenario(const LoadedScenario& scenario, const Communicator& ranks = Communicator::self());
// Writes an origin that was chosen automatically into the scenario, so that a resumed run has the same one.
void set_origin(LoadedScenario& scenario, const Vec3& origin);
// The same for the checksums of terrain, from a scene or from the scenario that a run began with.
void set_checksums(LoadedScenario& scenario, const Scene& scene);
void set_checksums(LoadedScenario& scenario, const io::Node& earlier);
// The scene alone, for a state that comes from a checkpoint. The scenario must have its origin.
Scene build_scene_only(const LoadedScenario& scenario);

}  // namespace scree::app
