#include <algorithm>
#include <cmath>

#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

using testing::build_good;
using testing::expect_error;
using testing::kHead;

std::string lattice(const std::string& more) {
    return kHead + "bodies:\n  - {generator: lattice, material: glass, corner: [1, 2, 3], " + more + "}\n";
}
const std::string kFixed = "size: {distribution: fixed, diameter: 0.1}, ";
const std::string kUniform = "size: {distribution: uniform, lower: 0.05, upper: 0.1}, ";

double nearest_distance(const Bodies& bodies) {
    double nearest = INFINITY;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            nearest = std::min(nearest, (bodies.position[i] - bodies.position[j]).norm());
        }
    }
    return nearest;
}

TEST(Lattice, PlacesAreInOrderXThenYThenZ) {
    const Bodies b = build_good(lattice(kFixed + "pitch: [0.1, 0.2, 0.3], cells: [2, 2, 2]")).state.bodies;
    ASSERT_EQ(b.size(), 8U);
    EXPECT_TRUE(b.position[0].isApprox(Vec3(1, 2, 3)));
    EXPECT_TRUE(b.position[1].isApprox(Vec3(1.1, 2, 3)));
    EXPECT_TRUE(b.position[2].isApprox(Vec3(1, 2.2, 3)));
    EXPECT_TRUE(b.position[7].isApprox(Vec3(1.1, 2.2, 3.3)));
    for (std::size_t i = 0; i < b.size(); ++i) EXPECT_EQ(raw(b.id[i]), i);
    EXPECT_DOUBLE_EQ(b.mass[3], Bodies::sphere_mass(0.05, 2500));
}

// Close packing: every body inside has 12 neighbours at the pitch, and none is nearer.
TEST(Lattice, HexagonalIsClosePacking) {
    const Bodies b = build_good(lattice(kFixed + "pitch: 0.1, cells: [7, 7, 7], arrangement: hexagonal")).state.bodies;
    EXPECT_NEAR(nearest_distance(b), 0.1, 1e-12);
    const Vec3 middle = b.position[3 + 7 * (3 + 7 * 3)];
    const auto near = [&](const Vec3& x) { return (x - middle).norm() < 0.1001; };
    EXPECT_EQ(std::count_if(b.position.begin(), b.position.end(), near), 13);
}

TEST(Lattice, CountStopsEarlyAndChangesNoBody) {
    const Bodies all = build_good(lattice(kUniform + "pitch: 0.2, cells: [4, 4, 4], jitter: 0.05")).state.bodies;
    const Bodies some =
        build_good(lattice(kUniform + "pitch: 0.2, cells: [4, 4, 4], jitter: 0.05, count: 21")).state.bodies;
    ASSERT_EQ(some.size(), 21U);
    for (std::size_t i = 0; i < some.size(); ++i) {
        EXPECT_EQ(some.position[i], all.position[i]);
        EXPECT_EQ(some.radius[i], all.radius[i]);
    }
}

TEST(Lattice, JitterStaysWithinItsBoundsAndReachesThem) {
    const Bodies b = build_good(lattice(kFixed + "pitch: 1, cells: [10, 10, 10], jitter: 0.2")).state.bodies;
    double largest = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        const Vec3 place(1.0 + static_cast<double>(i % 10), 2.0 + static_cast<double>(i / 10 % 10),
                         3.0 + static_cast<double>(i / 100));
        const double moved = (b.position[i] - place).cwiseAbs().maxCoeff();
        EXPECT_LE(moved, 0.2 + 1e-12);
        largest = std::max(largest, moved);
    }
    EXPECT_GT(largest, 0.19);
}

TEST(Lattice, ClipKeepsPlacesInsideTheRegion) {
    const Bodies b = build_good(lattice(kFixed + "pitch: 0.1, cells: [21, 21, 3], "
                                                 "clip: {shape: cylinder, base: [2, 3, 0], radius: 0.55, length: 10}"))
                         .state.bodies;
    std::size_t expected = 0;
    for (int i = -10; i <= 10; ++i) {
        for (int j = -10; j <= 10; ++j) expected += i * i + j * j <= 30 ? 3 : 0;
    }
    EXPECT_EQ(b.size(), expected);
}

TEST(Lattice, SeedAndGeneratorPickTheSizes) {
    const std::string two =
        "  - {generator: lattice, material: glass, corner: [9, 2, 3], " + kUniform + "pitch: 0.2, cells: [3, 1, 1]}\n";
    const std::string one = lattice(kUniform + "pitch: 0.2, cells: [3, 1, 1]");
    const Bodies both = build_good(one + two).state.bodies;
    EXPECT_NE(both.radius[0], both.radius[3]);
    EXPECT_NE(both.radius[0], build_good("seed: 2\n" + one).state.bodies.radius[0]);
    EXPECT_EQ(both.radius[0], build_good(one).state.bodies.radius[0]);
}

TEST(Lattice, TooFewPlacesAreAnError) {
    expect_error(lattice(kFixed + "pitch: 0.1, cells: [2, 2, 2], count: 9"), {"hold 8 bodies", "count (9)"});
    expect_error(lattice(kFixed + "pitch: 0.1, cells: [3, 3, 3], count: 20, clip: {shape: sphere, centre: [1, 2, 3], "
                                  "radius: 0.01}"),
                 {"only 1 of 20 bodies", "clip"});
    expect_error(lattice(kFixed + "pitch: 0.1, cells: [100000, 100000, 100000]"), {"more than one run can hold"});
}

TEST(Sphere, TakesRadiusOrDiameter) {
    const Bodies b =
        build_good(kHead +
                   "bodies:\n"
                   "  - {generator: sphere, material: glass, position: [1, 2, 3], radius: 0.1, velocity: [4, 5, 6], "
                   "spin: [7, 8, 9]}\n"
                   "  - {generator: sphere, material: steel, position: [2, 2, 3], diameter: 0.3}\n")
            .state.bodies;
    EXPECT_EQ(b.radius, (std::vector<double>{0.1, 0.15}));
    EXPECT_EQ(b.velocity[0], Vec3(4, 5, 6));
    EXPECT_EQ(b.spin[0], Vec3(7, 8, 9));
    EXPECT_EQ(b.spin[1], Vec3(0, 0, 0));
    EXPECT_DOUBLE_EQ(b.mass[1], Bodies::sphere_mass(0.15, 7800));
}

}  // namespace
}  // namespace scree
