// Every scenario that is shipped can be read and built, and is what its comment says.
#include <algorithm>
#include <map>

#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

const std::filesystem::path kFolder = SCREE_SCENARIO_DIR;

scenarios::Built build_file(const std::filesystem::path& path) {
    io::Diagnostics diagnostics;
    const io::ReadResult read = io::read_scenario(path.string(), {}, diagnostics);
    EXPECT_EQ(diagnostics.report(), "") << path;
    if (diagnostics.has_errors()) return {};
    scenarios::Built built = scenarios::build(read.root, path.parent_path().string(), diagnostics);
    EXPECT_EQ(diagnostics.report(), "") << path;
    EXPECT_EQ(diagnostics.warnings(), "") << path;
    return built;
}

const std::map<std::string, std::size_t> kBodies = {
    {"bouncing_ball", 1},  {"column_collapse", 6000}, {"hourglass", 1500},
    {"incline_sphere", 1}, {"inlet_box", 0},          {"newtons_cradle", 5},
    {"oblique_impact", 5}, {"rotating_drum", 3000},   {"silo_discharge", 10000},
    {"silo_small", 2000},  {"sliding_to_rolling", 1}, {"spinning_top_sphere", 1},
    {"stack", 10},         {"v_groove", 1},
};

TEST(ShippedScenarios, AllAreBuiltWithTheirBodies) {
    std::size_t found = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
        if (entry.path().extension() != ".yaml") continue;
        const std::string name = entry.path().stem().string();
        const auto expected = kBodies.find(name);
        ASSERT_NE(expected, kBodies.end()) << name << " is not listed in this test";
        EXPECT_EQ(build_file(entry.path()).state.bodies.size(), expected->second) << name;
        ++found;
    }
    EXPECT_EQ(found, kBodies.size());
}

TEST(ShippedScenarios, BeginWithTheSchemaAndAComment) {
    for (const auto& [name, bodies] : kBodies) {
        std::ifstream file(kFolder / (name + ".yaml"));
        std::string first, second, third;
        std::getline(file, first);
        std::getline(file, second);
        std::getline(file, third);
        EXPECT_EQ(first, "# yaml-language-server: $schema=scenario.schema.json") << name;
        EXPECT_EQ(second, "#") << name;
        EXPECT_GT(third.size(), 10U) << name;
    }
}

// No two bodies overlap at the start, but for touching ones.
TEST(ShippedScenarios, StartWithoutOverlap) {
    for (const auto& [name, expected] : kBodies) {
        const Bodies b = build_file(kFolder / (name + ".yaml")).state.bodies;
        std::vector<std::size_t> order(b.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::sort(order.begin(), order.end(), [&](auto i, auto j) { return b.position[i].z() < b.position[j].z(); });
        const double reach = b.size() == 0 ? 0.0 : 2.0 * *std::max_element(b.radius.begin(), b.radius.end());
        double deepest = 0.0;
        for (std::size_t i = 0; i < order.size(); ++i) {
            for (std::size_t j = i + 1; j < order.size(); ++j) {
                const std::size_t p = order[i], q = order[j];
                if (b.position[q].z() - b.position[p].z() > reach) break;
                const double gap = (b.position[p] - b.position[q]).norm() - b.radius[p] - b.radius[q];
                deepest = std::max(deepest, -gap / reach);
            }
        }
        EXPECT_LT(deepest, 1e-12) << name;
    }
}

TEST(ShippedScenarios, TheSmallSiloTakesTheRestFromTheLargeOne) {
    const scenarios::Built small = build_file(kFolder / "silo_small.yaml");
    const scenarios::Built large = build_file(kFolder / "silo_discharge.yaml");
    EXPECT_EQ(small.scene.time.step, large.scene.time.step);
    EXPECT_EQ(small.scene.outlets.size(), 1U);
    EXPECT_EQ(small.scene.pairs.all()[0].friction, 0.5);
    EXPECT_EQ(std::get<OrificeFloor>(small.scene.walls[1].shape).hole_radius, 0.018);
}

TEST(ShippedScenarios, SmoothScenesCarryNoSpin) {
    for (const auto& name : {"bouncing_ball", "v_groove", "newtons_cradle"}) {
        EXPECT_TRUE(build_file(kFolder / (std::string(name) + ".yaml")).state.bodies.spin.empty()) << name;
    }
}

}  // namespace
}  // namespace scree
