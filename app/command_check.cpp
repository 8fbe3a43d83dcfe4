// scree check: everything that `run` does before its first step, and a report instead of the run.
#include <fmt/format.h>
#include <unistd.h>

#include "app/check_report.hpp"
#include "app/commands.hpp"
#include "app/load_scenario.hpp"
#include "app/memory_model.hpp"
#include "app/scene_warnings.hpp"

namespace scree::app {

ExitCode check_command(const CheckOptions& options) {
    const LoadedScenario scenario = load_scenario(options.scenario, options.sets);
    BuiltScenario built = build_scenario(scenario);
    Plan plan = make_plan(built.scene, built.state.bodies);
    measure_memory(built.scene, plan);
    write_all(STDERR_FILENO, scenario.diagnostics->warnings());
    fmt::print("{}", check_report(options.scenario, built.scene, plan, built.state, built.shape_name,
                                  scene_warnings(built.scene, built.state), options.ranks));
    return ExitCode::complete;
}

}  // namespace scree::app
