#include "app/load_scenario.hpp"

#include <filesystem>

#include "app/error_agreement.hpp"
#include "core/terrain.hpp"
#include "io/scenario/diagnostics.hpp"
#include "io/scenario/scenario_reader.hpp"
#include "scenarios/build.hpp"
#include "solvers/energy.hpp"

namespace scree::app {
namespace {

// The others know the scenario by its resolved text: rank 0 has the right lines and columns.
void throw_if_errors(const io::Diagnostics& diagnostics, const Communicator& ranks) {
    at_root(ranks, [&] { diagnostics.throw_if_errors(); });
}

LoadedScenario loaded(io::ReadResult result, const std::string& name, std::shared_ptr<io::Diagnostics> diagnostics) {
    diagnostics->throw_if_errors();
    return {std::move(result.root), name, std::move(result.text), std::move(result.resolved), folder_of(name),
            std::move(diagnostics)};
}

}  // namespace

std::string folder_of(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    return folder.empty() ? "." : folder.string();
}

LoadedScenario load_scenario(const std::string& path, const std::vector<std::string>& sets, const Communicator& ranks) {
    LoadedScenario scenario;
    at_root(ranks, [&] {
        auto diagnostics = std::make_shared<io::Diagnostics>();
        scenario = loaded(io::read_scenario(path, sets, *diagnostics), path, diagnostics);
    });
    if (ranks.alone()) return scenario;
    std::string text = scenario.text, resolved = scenario.resolved;
    ranks.broadcast(text);
    ranks.broadcast(resolved);
    if (!ranks.root()) scenario = load_resolved(resolved, path, {});
    scenario.text = std::move(text);
    scenario.resolved = std::move(resolved);
    return scenario;
}

LoadedScenario load_resolved(const std::string& resolved, const std::string& name,
                             const std::vector<std::string>& sets) {
    auto diagnostics = std::make_shared<io::Diagnostics>();
    return loaded(io::read_scenario_text(resolved, name, sets, *diagnostics), name, diagnostics);
}

BuiltScenario build_scenario(const LoadedScenario& scenario, const Communicator& ranks) {
    scenarios::Built built = scenarios::build(scenario.root, scenario.folder, *scenario.diagnostics, ranks);
    throw_if_errors(*scenario.diagnostics, ranks);
    solvers::start_ledger(built.scene, built.state, ranks);
    return {std::move(built.scene), std::move(built.state), std::move(built.shape_name)};
}

void set_origin(LoadedScenario& scenario, const Vec3& origin) {
    io::Node& node = std::get<io::Node::Map>(scenario.root.value)["origin"];
    node.value = origin;
    node.path = "origin";
    scenario.resolved = io::resolved_text(scenario.root);
}

// checksum_of(i) of wall i; empty: unknown.
template <class ChecksumOf>
void set_absent_checksums(LoadedScenario& scenario, ChecksumOf checksum_of) {
    if (!scenario.root.has("walls")) return;
    auto& walls = std::get<io::Node::List>(std::get<io::Node::Map>(scenario.root.value).at("walls").value);
    for (std::size_t i = 0; i < walls.size(); ++i) {
        if (walls[i].text("shape") != "terrain" || walls[i].has("checksum")) continue;
        const std::string checksum = checksum_of(i);
        if (checksum.empty()) continue;
        io::Node& node = std::get<io::Node::Map>(walls[i].value)["checksum"];
        node.value = checksum;
        node.path = walls[i].path + ".checksum";
        node.mark = walls[i].at("path").mark;
    }
    scenario.resolved = io::resolved_text(scenario.root);
}

void set_checksums(LoadedScenario& scenario, const Scene& scene) {
    set_absent_checksums(scenario, [&](std::size_t i) {
        const auto* wall = std::get_if<TerrainWall>(&scene.walls[i].shape);
        return wall == nullptr ? std::string() : wall->terrain->checksum;
    });
}

void set_checksums(LoadedScenario& scenario, const io::Node& earlier) {
    if (!earlier.has("walls")) return;
    const io::Node::List& walls = earlier.at("walls").items();
    set_absent_checksums(scenario, [&](std::size_t i) {
        return i < walls.size() && walls[i].has("checksum") ? walls[i].text("checksum") : std::string();
    });
}

Scene build_scene_only(const LoadedScenario& scenario) {
    SCREE_CHECK(scenario.root.has("origin"));
    Scene scene = scenarios::build_scene(scenario.root, scenario.folder, *scenario.diagnostics);
    scenario.diagnostics->throw_if_errors();
    return scene;
}

}  // namespace scree::app
