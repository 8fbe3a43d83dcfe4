// Every scenario that is shipped can be read and built, and is what its comment says.
#include <algorithm>
#include <deque>
#include <map>

#include "contact/polyhedra/polyhedron_polyhedron.hpp"
#include "io/scenario/schema_json.hpp"
#include "io/scenario/schema_text.hpp"
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
    {"landslide", 22796},  {"rock_avalanche", 5751},  {"rockfall", 93},
    {"arch", 11},          {"block_wall", 410},       {"bricks", 1500},
    {"dominoes", 30},      {"jointed_slope", 170},    {"polyhedra_drop", 200},
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

// After a change of a key: scree schema --reference > scenarios/REFERENCE.md; scree schema >
// scenarios/scenario.schema.json.
TEST(ShippedScenarios, TheReferenceAndTheSchemaTellOfTheKeysAsTheyAre) {
    const auto text = [](const char* name) {
        std::ifstream file(kFolder / name);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    EXPECT_TRUE(text("REFERENCE.md") == io::reference_markdown());
    EXPECT_TRUE(text("scenario.schema.json") == io::schema_json());
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

// The bodies of a scene, placed.
class PlacedBodies {
  public:
    explicit PlacedBodies(const State& state) : bodies_(state.bodies) {
        for (std::size_t i = 0; i < bodies_.size() && bodies_.has_shapes(); ++i) {
            if (is_sphere(i)) {
                placed_.emplace_back();
                continue;
            }
            const ConvexShape& shape = state.shapes[raw(bodies_.shape[i])];
            room_.emplace_back(contact::placed_size(shape));
            placed_.push_back(contact::place(shape, bodies_.position[i], bodies_.orientation[i], room_.back()));
        }
    }
    // Of a sphere and a polyhedron: from the ball that holds it.
    double gap(std::size_t i, std::size_t j) {
        const double balls = (bodies_.position[i] - bodies_.position[j]).norm() - bodies_.radius[i] - bodies_.radius[j];
        if (is_sphere(i) || is_sphere(j) || balls > 0.0) return balls;
        return contact::polyhedra_gap(placed_[i], placed_[j], 1.0, scratch_).gap;
    }
    // Of a body from a plane.
    double gap(std::size_t i, const PlaneWall& plane) const {
        const double height = plane.normal.dot(bodies_.position[i] - plane.point);
        if (is_sphere(i)) return height - bodies_.radius[i];
        return height + contact::lowest(placed_[i], plane.normal).height;
    }

  private:
    bool is_sphere(std::size_t i) const { return !bodies_.has_shapes() || bodies_.shape[i] == kSphere; }

    const Bodies& bodies_;
    std::deque<std::vector<Vec3>> room_;
    std::vector<contact::Placed> placed_;
    contact::PolyhedraScratch scratch_;
};

// Neither two bodies nor a body and a plane overlap at the start, but for touching ones.
TEST(ShippedScenarios, StartWithoutOverlap) {
    for (const auto& [name, expected] : kBodies) {
        const scenarios::Built built = build_file(kFolder / (name + ".yaml"));
        const Bodies& b = built.state.bodies;
        PlacedBodies placed(built.state);
        std::vector<std::size_t> order(b.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::sort(order.begin(), order.end(), [&](auto i, auto j) { return b.position[i].z() < b.position[j].z(); });
        const double reach = b.size() == 0 ? 0.0 : 2.0 * *std::max_element(b.radius.begin(), b.radius.end());
        double deepest = 0.0;
        for (std::size_t i = 0; i < order.size(); ++i) {
            for (std::size_t j = i + 1; j < order.size(); ++j) {
                if (b.position[order[j]].z() - b.position[order[i]].z() > reach) break;
                deepest = std::max(deepest, -placed.gap(order[i], order[j]) / reach);
            }
            for (const Wall& wall : built.scene.walls)
                if (const auto* plane = std::get_if<PlaneWall>(&wall.shape); plane != nullptr && wall.present(0.0))
                    deepest = std::max(deepest, -placed.gap(order[i], *plane) / reach);
        }
        // numbers in the file have nine digits
        EXPECT_LT(deepest, b.has_shapes() ? 1e-8 : 1e-12) << name;
    }
}

TEST(ShippedScenarios, TheFirstDominoStandsOnItsEdge) {
    const scenarios::Built built = build_file(kFolder / "dominoes.yaml");
    std::vector<Vec3> lowest;
    for (const Vec3& x : built.state.shapes[0].vertex) {
        const Vec3 at = built.state.bodies.position[0] + built.state.bodies.orientation[0] * x;
        if (at.z() < 1e-8) lowest.push_back(at);
    }
    ASSERT_EQ(lowest.size(), 2U);
    for (const Vec3& x : lowest) EXPECT_NEAR(x.x(), 3.75e-3, 1e-8);
}

TEST(ShippedScenarios, TheJointedSlopeIsFilled) {
    const State state = build_file(kFolder / "jointed_slope.yaml").state;
    double mass = 0.0;
    for (const double m : state.bodies.mass) mass += m;
    EXPECT_NEAR(mass, 2700.0 * 8.0 * 70.0, 1e-6);
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
