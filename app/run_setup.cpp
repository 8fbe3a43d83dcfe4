#include "app/run_setup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "app/error_agreement.hpp"
#include "app/load_scenario.hpp"
#include "app/scenario_difference.hpp"
#include "app/scene_warnings.hpp"
#include "io/atomic_file.hpp"
#include "io/results/checkpoint.hpp"
#include "solvers/trajectories.hpp"

namespace scree::app {
namespace {

// What differs from rank to rank (the name of the machine, the moment, the id of the run) is that of rank 0.
void share(io::Provenance& provenance, const Communicator& ranks) {
    for (std::string io::Provenance::*field :
         {&io::Provenance::hostname, &io::Provenance::slurm_job_id, &io::Provenance::created_utc,
          &io::Provenance::run_id, &io::Provenance::command_line}) {
        ranks.broadcast(provenance.*field);
    }
}

io::Provenance provenance_of(const RunOptions& options, const LoadedScenario& scenario, const Scene& scene,
                             const Communicator& ranks) {
    io::RunDescription run;
    run.scenario_name = scenario.name;
    run.scenario_text = scenario.text;
    run.scenario_resolved = scenario.resolved;
    run.command_line = options.command_line;
    run.seed = scene.seed;
    run.ranks = ranks.size();
    io::Provenance provenance = io::make_provenance(run);
    share(provenance, ranks);
    return provenance;
}

RunSetup set_up_new(const RunOptions& options, RunFolder& folder, const Communicator& ranks) {
    LoadedScenario scenario = load_scenario(options.scenario, options.sets, ranks);
    const bool replace = options.force || options.resume;
    at_root(ranks, [&] { folder.check_free(replace); });  // before the bodies are made, which can take long
    BuiltScenario built = build_scenario(scenario, ranks);
    set_origin(scenario, built.scene.origin);
    set_checksums(scenario, built.scene);
    RunSetup setup{std::move(built.scene), std::move(built.state), {}, false, {}};
    setup.state.followed = solvers::choose_followed(setup.scene.trajectories, setup.state.bodies, ranks);
    setup.provenance = provenance_of(options, scenario, setup.scene, ranks);
    setup.scenario_warnings = scenario.diagnostics->warnings();
    setup.warnings = scene_warnings(setup.scene, setup.state, ranks);
    at_root(ranks, [&] { folder.start(replace); });
    return setup;
}

// The scenario that a run goes on with: that of the checkpoint, with changes that alter no step made so far.
LoadedScenario scenario_to_go_on_with(const RunOptions& options, const io::FoundCheckpoint& found,
                                      const Communicator& ranks) {
    const std::string& resolved = found.provenance.scenario_resolved;
    const LoadedScenario earlier = load_resolved(resolved, found.path, {});
    LoadedScenario now = options.scenario.empty() ? load_resolved(resolved, found.path, options.sets)
                                                  : load_scenario(options.scenario, options.sets, ranks);
    if (options.scenario.empty()) {
        now.name = found.provenance.scenario_name;
        now.text = found.provenance.scenario_text;
        now.folder = folder_of(now.name);  // terrain is read from where it was
    }
    if (!now.root.has("origin")) set_origin(now, earlier.root.vector("origin"));
    set_checksums(now, earlier.root);
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

RunSetup set_up_resumed(const RunOptions& options, const RunFolder& folder, io::FoundCheckpoint found,
                        const Communicator& ranks) {
    const LoadedScenario scenario = scenario_to_go_on_with(options, found, ranks);
    RunSetup setup{build_scene_only(scenario), std::move(found.state), {}, true, found.messages};
    setup.provenance = provenance_of(options, scenario, setup.scene, ranks);
    io::continue_run(setup.provenance, found.provenance);
    at_root(ranks, [&] {
        set_aside_unreadable(folder, found);
        for (const auto& path : {folder.path(), folder.snapshots(), folder.checkpoints()}) {
            io::remove_leftovers(path.string());
        }
    });
    return setup;
}

}  // namespace

RunSetup set_up_run(const RunOptions& options, RunFolder& folder, const Communicator& ranks) {
    if (!options.resume) return set_up_new(options, folder, ranks);
    if (ranks.any(ranks.root() && folder.exists())) {
        at_root(ranks, [&] { folder.resume(); });
        if (auto found = io::find_latest_checkpoint(folder.checkpoints().string(), ranks)) {
            return set_up_resumed(options, folder, std::move(*found), ranks);
        }
    }
    if (!options.scenario.empty()) return set_up_new(options, folder, ranks);
    throw IoError(fmt::format("the folder '{}' holds no checkpoint to go on from; give the scenario to start anew",
                              folder.path().string()));
}

}  // namespace scree::app
