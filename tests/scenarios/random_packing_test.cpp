#include <numbers>
#include <numeric>

#include "contact/walls/wall_contact.hpp"
#include "core/random.hpp"
#include "scenarios/sphere_grid.hpp"
#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

using testing::build_good;
using testing::expect_error;
using testing::kHead;

std::string random_bodies(const std::string& more,
                          const std::string& region = "{shape: box, lower: [0, 0, 0], upper: [1, 1, 1]}") {
    return kHead + "bodies:\n  - {generator: random, material: glass, region: " + region + ", " + more + "}\n";
}
const std::string kSizes = "size: {distribution: uniform, lower: 0.05, upper: 0.15}";

double smallest_gap(const Bodies& b) {
    double smallest = INFINITY;
    for (std::size_t i = 0; i < b.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            smallest = std::min(smallest, (b.position[i] - b.position[j]).norm() - b.radius[i] - b.radius[j]);
        }
    }
    return smallest;
}

double solid_volume(const Bodies& b) {
    return std::accumulate(b.radius.begin(), b.radius.end(), 0.0,
                           [](double sum, double r) { return sum + Bodies::sphere_mass(r, 1.0); });
}

TEST(RandomPacking, CountBodiesWithoutOverlapInsideTheRegion) {
    const Bodies b = build_good(random_bodies(kSizes + ", count: 300")).state.bodies;
    ASSERT_EQ(b.size(), 300U);
    EXPECT_GE(smallest_gap(b), 0.0);
    for (std::size_t i = 0; i < b.size(); ++i) {
        EXPECT_GE((b.position[i].array() - b.radius[i]).minCoeff(), -1e-15);
        EXPECT_LE((b.position[i].array() + b.radius[i]).maxCoeff(), 1.0 + 1e-15);
    }
}

TEST(RandomPacking, GapIsKept) {
    const Bodies b = build_good(random_bodies(kSizes + ", count: 100, gap: 0.03")).state.bodies;
    EXPECT_GE(smallest_gap(b), 0.03 - 1e-15);
}

TEST(RandomPacking, PackingFractionAndMassAreReachedByTheLastBody) {
    const Bodies packed = build_good(random_bodies(kSizes + ", packing_fraction: 0.25")).state.bodies;
    EXPECT_GE(solid_volume(packed), 0.25);
    EXPECT_LT(solid_volume(packed) - Bodies::sphere_mass(packed.radius.back(), 1.0), 0.25);

    const Bodies weighed = build_good(random_bodies(kSizes + ", mass: 100")).state.bodies;
    const double mass = std::accumulate(weighed.mass.begin(), weighed.mass.end(), 0.0);
    EXPECT_GE(mass, 100.0);
    EXPECT_LT(mass - weighed.mass.back(), 100.0);
}

TEST(RandomPacking, CylinderAndSphereAreFilledEvenly) {
    const std::string small = "size: {distribution: fixed, diameter: 0.001}, count: 4000";
    const Bodies ball =
        build_good(random_bodies(small, "{shape: sphere, centre: [1, 2, 3], radius: 0.5}")).state.bodies;
    std::size_t inner = 0;
    for (const Vec3& x : ball.position) inner += (x - Vec3(1, 2, 3)).norm() < 0.25 ? 1 : 0;
    EXPECT_NEAR(static_cast<double>(inner) / 4000.0, 0.125, 0.021);  // 4 standard errors

    const Bodies rod =
        build_good(random_bodies(small, "{shape: cylinder, base: [1, 2, 3], axis: [1, 1, 0], radius: 0.5, length: 2}"))
            .state.bodies;
    const Vec3 axis = Vec3(1, 1, 0).normalized();
    std::size_t low = 0, core = 0;
    for (const Vec3& x : rod.position) {
        const double along = (x - Vec3(1, 2, 3)).dot(axis);
        ASSERT_TRUE(along > 0.0 && along < 2.0);
        low += along < 0.5 ? 1 : 0;
        core += (x - Vec3(1, 2, 3) - along * axis).norm() < 0.25 ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(low) / 4000.0, 0.25, 0.028);
    EXPECT_NEAR(static_cast<double>(core) / 4000.0, 0.25, 0.028);
}

TEST(RandomPacking, KeepsClearOfEarlierBodiesAndOfWalls) {
    const scenarios::Built built = build_good(
        kHead +
        "bodies:\n"
        "  - {generator: sphere, material: glass, position: [0.5, 0.5, 0.5], radius: 0.3}\n"
        "  - {generator: random, material: glass, region: {shape: box, lower: [0, 0, 0], upper: [1, 1, 1]},\n"
        "     size: {distribution: fixed, diameter: 0.06}, count: 200}\n"
        "walls:\n"
        "  - {shape: plane, name: slope, material: glass, point: [0, 0, 0.2], normal: [-1, 0, 3]}\n"
        "  - {shape: plane, name: later, material: glass, point: [0, 0, 0.9], normal: [0, 0, 1], appears: 0.5}\n");
    const Bodies& b = built.state.bodies;
    EXPECT_GE(smallest_gap(b), 0.0);
    for (std::size_t i = 1; i < b.size(); ++i) {
        contact::WallContacts contacts;
        contact::find_contacts(built.scene.walls[0].shape, b.position[i], b.radius[i], 0.0, contacts);
        for (int c = 0; c < contacts.count; ++c) EXPECT_GE(contacts.item[static_cast<std::size_t>(c)].gap, 0.0);
    }
}

TEST(RandomPacking, SaysHowManyWerePlaced) {
    expect_error(random_bodies("size: {distribution: fixed, diameter: 0.4}, count: 100, attempts: 50"),
                 {"of 100 bodies could be placed", "50 places were tried", "packing fraction"});
    expect_error(random_bodies("size: {distribution: fixed, diameter: 1.2}, count: 1"), {"only 0 of 1", "too large"});
    expect_error(random_bodies("size: {distribution: fixed, diameter: 0.1}, mass: 3000"), {"do not fit"});
    expect_error(random_bodies("size: {distribution: fixed, diameter: 0.1}, count: 3",
                               "{shape: half_space, point: [0, 0, 0], normal: [0, 0, 1]}"),
                 {"half_space"});
}

// Against all pairs, for a wide mixture of sizes.
TEST(SphereGrid, AgreesWithAllPairs) {
    scenarios::SphereGrid grid;
    std::vector<std::pair<Vec3, double>> placed;
    std::size_t free_count = 0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        Random random(5, 0, i);
        const Vec3 x(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const double radius = 0.002 * std::pow(100.0, random.uniform());
        bool is_free = true;
        for (const auto& [y, r] : placed) is_free = is_free && (x - y).norm() >= radius + r + 0.001;
        ASSERT_EQ(grid.is_free(x, radius, 0.001), is_free) << i;
        if (!is_free) continue;
        ++free_count;
        placed.emplace_back(x, radius);
        grid.add(x, radius);
    }
    EXPECT_GT(free_count, 100U);
    EXPECT_LT(free_count, 2900U);
}

}  // namespace
}  // namespace scree
