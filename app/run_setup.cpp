#include "app/run_setup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "app/load_scenario.hpp"
#include "app/scenario_difference.hpp"
#include "app/scene_warnings.hpp"
#include "io/atomic_file.hpp"
#include "io/results/checkpoint.hpp"

namespace scree::app {
namespace {

io::Provenance provenance_of(const RunOptions& options, const LoadedScenario& scenario, const Scene& scene) {
    io::RunDescription run;
    run.scenario_name = scenario.name;
    run.scenario_text = scenario.text;
    run.scenario_resolved = scenario.resolved;
    run.command_line = options.command_line;
    run.seed = scene.seed;
    return io::make_provenance(run);
}

RunSetup set_up_new(const RunOptions& options, RunFolder& folder) {
    LoadedScenario scenario = load_scenario(options.scenario, options.sets);
    const bool replace = options.force || options.resume;
    folder.check_free(replace);  // before the bodies are made, which can take long
    BuiltScenario built = build_scenario(scenario);
    set_origin(scenario, built.scene.origin);
    RunSetup setup{std::move(built.scene), std::move(built.state), {}, false, {}};
    setup.provenance = provenance_of(options, scenario, setup.scene);
    setup.scenario_warnings = scenario.diagnostics->warnings();
    setup.warnings = scene_warnings(setup.scene, setup.state);
    folder.start(replace);
    return setup;
}

// The scenario that a run goes on with: that of the checkpoint, with changes that alter no step made so far.
LoadedScenario scenario_to_go_on_with(const RunOptions& options, const io::FoundCheckpoint& found) {
    const std::string& resolved = found.provenance.scenario_resolved;
    const LoadedScenario earlier = load_resolved(resolved, found.path, {});
    LoadedScenario now = options.scenario.empty() ? load_resolved(resolved, found.path, options.sets)
                                                  : load_scenario(options.scenario, options.sets);
    if (options.scenario.empty()) {
        now.name = found.provenance.scenario_name;
        now.text = found.provenance.scenario_text;
    }
    if (!now.root.has("origin")) set_origin(now, earlier.root.vector("origin"));
    std::vector<std::string> refused;
    for (const std::string& key : differing_keys(earlier.root, now.root)) {
        if (!may_change_on_resume(key)) refused.push_back(key);
    }
    if (!refused.empty()) {
        throw ScenarioError(
            fmt::format("error: the scenario differs from that of the run to go on with ({}) in: {}\n"
                        "  A run goes on with what it began with; only time.end and output may change. Leave the "
                        "scenario out to go\n"
                        "  on with the checkpoint's own, or start another run with --out.",
                        found.path, fmt::join(refused, ", ")));
    }
    return now;
}

// Newer checkpoints that could not be read would push good ones out (the last two are kept).
void set_aside_unreadable(const RunFolder& folder, const io::FoundCheckpoint& found) {
    for (const std::string& path : io::list_checkpoints(folder.checkpoints().string())) {
        if (path == found.path) return;
        std::error_code ignored;
        std::filesystem::rename(path, path + ".unreadable", ignored);
    }
}

RunSetup set_up_resumed(const RunOptions& options, const RunFolder& folder, io::FoundCheckpoint found) {
    const LoadedScenario scenario = scenario_to_go_on_with(options, found);
    RunSetup setup{build_scene_only(scenario), std::move(found.state), {}, true, found.messages};
    setup.provenance = provenance_of(options, scenario, setup.scene);
    io::continue_run(setup.provenance, found.provenance);
    set_aside_unreadable(folder, found);
    for (const auto& path : {folder.path(), folder.snapshots(), folder.checkpoints()}) {
        io::remove_leftovers(path.string());
    }
    return setup;
}

}  // namespace

RunSetup set_up_run(const RunOptions& options, RunFolder& folder) {
    if (!options.resume) return set_up_new(options, folder);
    if (folder.exists()) {
        folder.resume();
        if (auto found = io::find_latest_checkpoint(folder.checkpoints().string())) {
            return set_up_resumed(options, folder, std::move(*found));
        }
    }
    if (!options.scenario.empty()) return set_up_new(options, folder);
    throw IoError(fmt::format("the folder '{}' holds no checkpoint to go on from; give the scenario to start anew",
                              folder.path().string()));
}

}  // namespace scree::app
