#include "app/load_scenario.hpp"

#include <filesystem>

#include "io/scenario/diagnostics.hpp"
#include "io/scenario/scenario_reader.hpp"
#include "scenarios/build.hpp"
#include "solvers/energy.hpp"

namespace scree::app {
namespace {

std::string folder_of(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    return folder.empty() ? "." : folder.string();
}

LoadedScenario loaded(io::ReadResult result, const std::string& name, std::shared_ptr<io::Diagnostics> diagnostics) {
    diagnostics->throw_if_errors();
    return {std::move(result.root), name, std::move(result.text), std::move(result.resolved), folder_of(name),
            std::move(diagnostics)};
}

}  // namespace

LoadedScenario load_scenario(const std::string& path, const std::vector<std::string>& sets) {
    auto diagnostics = std::make_shared<io::Diagnostics>();
    return loaded(io::read_scenario(path, sets, *diagnostics), path, diagnostics);
}

LoadedScenario load_resolved(const std::string& resolved, const std::string& name,
                             const std::vector<std::string>& sets) {
    auto diagnostics = std::make_shared<io::Diagnostics>();
    return loaded(io::read_scenario_text(resolved, name, sets, *diagnostics), name, diagnostics);
}

BuiltScenario build_scenario(const LoadedScenario& scenario) {
    scenarios::Built built = scenarios::build(scenario.root, scenario.folder, *scenario.diagnostics);
    scenario.diagnostics->throw_if_errors();
    solvers::start_ledger(built.scene, built.state);
    return {std::move(built.scene), std::move(built.state)};
}

void set_origin(LoadedScenario& scenario, const Vec3& origin) {
    io::Node& node = std::get<io::Node::Map>(scenario.root.value)["origin"];
    node.value = origin;
    node.path = "origin";
    scenario.resolved = io::resolved_text(scenario.root);
}

Scene build_scene_only(const LoadedScenario& scenario) {
    SCREE_CHECK(scenario.root.has("origin"));
    Scene scene = scenarios::build_scene(scenario.root, scenario.folder, *scenario.diagnostics);
    scenario.diagnostics->throw_if_errors();
    return scene;
}

}  // namespace scree::app
