// Release areas: what is taken from a terrain, and the bodies in its place.
#include <cmath>

#include "contact/walls/wall_contact.hpp"
#include "core/terrain.hpp"
#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

using testing::build_good;
using testing::expect_error;
using testing::kHead;
using testing::TemporaryFolder;

constexpr const char* kSquare = "perimeter: [[19.5, 19.5], [60.5, 19.5], [60.5, 60.5], [19.5, 60.5]]";

std::string wall(const std::string& perimeter, const std::string& planes) {
    return "walls:\n  - {shape: terrain, name: hill, material: steel, path: hill.asc, release: {" + perimeter +
           ", planes: [" + planes + "]}}\n";
}
std::string bodies(const std::string& more) {
    return "bodies:\n  - {generator: release, wall: hill, material: glass, " + more + "}\n";
}

// 81 x 81 nodes 1 m apart from [0, 0] on, at heights that fall by 1 in 2 to the east, 100 m at x = 0; one hole.
struct Hill {
    TemporaryFolder folder;

    Hill() {
        std::string text = "ncols 81\nnrows 81\nxllcenter 0\nyllcenter 0\ncellsize 1\nNODATA_value -9999\n";
        for (int j = 80; j >= 0; --j) {
            for (int i = 0; i <= 80; ++i) text += (i == 5 && j == 5 ? "-9999" : std::to_string(100.0 - 0.5 * i)) + " ";
            text += "\n";
        }
        folder.write("hill.asc", text);
    }
    scenarios::Built build(const std::string& text) const { return build_good(kHead + text, folder.path()); }
    void refused(const std::string& text, const std::vector<std::string>& parts) const {
        expect_error(kHead + text, parts, folder.path());
    }
    static const Terrain& terrain(const scenarios::Built& built) {
        return *std::get<TerrainWall>(built.scene.walls.at(0).shape).terrain;
    }
};

// A level plane at 70 m: 100 - x / 2 - 70 is taken from the nodes x, y = 20..60, none at x = 60.
TEST(Release, WhatLiesAboveTheHighestPlaneIsTaken) {
    const Hill hill;
    const std::string level = "{point: [7, 8, 70], dip: 0}";
    const scenarios::Built built = hill.build(wall(kSquare, level));
    const Terrain& terrain = Hill::terrain(built);
    double sum = 0.0;
    for (int x = 20; x <= 60; ++x) sum += 41.0 * (30.0 - 0.5 * x);
    ASSERT_TRUE(terrain.release);
    EXPECT_NEAR(terrain.release->volume, sum, 1e-9 * sum);
    EXPECT_EQ(terrain.release->area, 40.0 * 41.0);
    EXPECT_NEAR(terrain.release->deepest, 20.0, 1e-12);
    const HeightGrid& grid = *terrain.grid;
    for (std::uint32_t j = 0; j < 81; ++j)
        for (std::uint32_t i = 0; i < 81; ++i) {
            if (!grid.has(i, j)) continue;
            const bool taken = i >= 20 && i < 60 && j >= 20 && j <= 60;
            const double z = grid.at(i, j) + built.scene.origin.z();
            EXPECT_NEAR(z, taken ? 70.0 : 100.0 - 0.5 * i, 1e-12) << i << ' ' << j;
            EXPECT_NEAR(terrain.release->thickness[j * 81 + i], taken ? 30.0 - 0.5 * i : 0.0, 1e-12);
        }
    // The second is higher for y > 40, by tan(45 deg) a metre; it falls to the south.
    const std::string falling = ", {point: [0, 40, 70], dip: 45 deg, dip_direction: 180 deg}";
    const scenarios::Built two = hill.build(wall(kSquare, level + falling));
    const HeightGrid& cut = *Hill::terrain(two).grid;
    EXPECT_NEAR(cut.at(30, 35) + two.scene.origin.z(), 70.0, 1e-12);
    EXPECT_NEAR(cut.at(30, 45) + two.scene.origin.z(), 75.0, 1e-9);
    EXPECT_NEAR(cut.at(30, 58) + two.scene.origin.z(), 85.0, 1e-9);
    EXPECT_LT(Hill::terrain(two).release->volume, 0.8 * sum);
    // azimuths count clockwise from north: this one falls to the east, as the hill does
    const scenarios::Built east = hill.build(
        wall(kSquare, "{point: [40, 3, 75], dip: " + std::to_string(std::atan(0.5)) + ", dip_direction: 90 deg}"));
    EXPECT_NEAR(Hill::terrain(east).release->volume, 41.0 * 41.0 * 5.0, 1e-2);
}

TEST(Release, IsTheSameWhereverTheOriginIs) {
    const Hill hill;
    const std::string text = wall(kSquare, "{point: [7, 8, 70], dip: 10 deg, dip_direction: 30 deg}") +
                             bodies("size: {distribution: fixed, diameter: 3}");
    const scenarios::Built here = hill.build("origin: [0, 0, 0]\n" + text),
                           there = hill.build("origin: [64, -32, 128]\n" + text);
    EXPECT_NEAR(Hill::terrain(here).release->volume, Hill::terrain(there).release->volume, 1e-6);
    ASSERT_EQ(here.state.bodies.size(), there.state.bodies.size());
    for (std::size_t i = 0; i < here.state.bodies.size(); ++i) {
        const Vec3 x = here.state.bodies.position[i] - there.state.bodies.position[i];
        EXPECT_LT((x - Vec3(64, -32, 128)).norm(), 1e-9);
    }
}

void expect_clear(const scenarios::Built& built) {
    const Bodies& b = built.state.bodies;
    const Terrain& terrain = Hill::terrain(built);
    for (std::size_t i = 0; i < b.size(); ++i) {
        const Vec3 x = b.position[i] + built.scene.origin;
        EXPECT_GE(x.z() - b.radius[i], 70.0 - 1e-9);
        EXPECT_LE(x.z() + b.radius[i], 100.0 - 0.5 * x.x() + 1e-9);
        EXPECT_FALSE(terrain.under(b.position[i]));
        contact::WallContacts found;
        contact::find_contacts(built.scene.walls[0].shape, b.position[i], b.radius[i], 0.0, found);
        for (int k = 0; k < found.count; ++k) EXPECT_GE(found.item[static_cast<std::size_t>(k)].gap, -1e-9);
        for (std::size_t j = 0; j < i; ++j)
            ASSERT_GE((b.position[i] - b.position[j]).norm(), (b.radius[i] + b.radius[j]) * (1.0 - 1e-12));
    }
}

TEST(Release, SpheresFillIt) {
    const Hill hill;
    const std::string ground = wall(kSquare, "{point: [0, 0, 70], dip: 0}");
    const scenarios::Built full = hill.build(ground + bodies("size: {distribution: fixed, diameter: 1}"));
    expect_clear(full);
    const double share =
        static_cast<double>(full.state.bodies.size()) * M_PI / 6.0 / Hill::terrain(full).release->volume;
    EXPECT_GT(share, 0.60);
    EXPECT_LT(share, 0.74);
    // fewer are the lowest ones, as a share of the depth
    const scenarios::Built few = hill.build(ground + bodies("size: {distribution: fixed, diameter: 1}, count: 500"));
    ASSERT_EQ(few.state.bodies.size(), 500U);
    expect_clear(few);
    for (const Vec3& x : few.state.bodies.position) {
        const Vec3 at = x + few.scene.origin;
        EXPECT_LT((at.z() - 70.0) / (30.0 - 0.5 * at.x()), 0.2);
    }
    const scenarios::Built half = hill.build(
        ground + bodies("size: {distribution: uniform, lower: 0.8, upper: 1}, solid_fraction: 0.3, gap: 1 cm"));
    expect_clear(half);
    double solid = 0.0;
    for (const double mass : half.state.bodies.mass) solid += mass / 2500.0;
    EXPECT_NEAR(solid / Hill::terrain(half).release->volume, 0.3, 1e-4);
}

TEST(Release, PolyhedraAndSpheresMixed) {
    const Hill hill;
    const std::string ground = wall(kSquare, "{point: [0, 0, 70], dip: 0}");
    const std::string shapes = "shapes: [{name: r, kind: rock, variants: 3, diameter: 2}]\n";
    const scenarios::Built built =
        hill.build(shapes + ground + bodies("shape: r, orientation: {random: true}, spheres: 0.4"));
    expect_clear(built);
    const Bodies& b = built.state.bodies;
    double spheres = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        EXPECT_NEAR(b.mass[i], 2500.0 * M_PI * 8.0 / 6.0, 1e-6);
        spheres += b.shape[i] == kSphere ? 1.0 : 0.0;
    }
    EXPECT_GT(b.size(), 400U);
    EXPECT_NEAR(spheres / static_cast<double>(b.size()), 0.4, 0.08);
}

TEST(Release, WrongOnesAreRefused) {
    const Hill hill;
    const std::string level = "{point: [0, 0, 70], dip: 0}";
    hill.refused(wall("perimeter: [[0, 0], [1, 1]]", level), {"test.yaml:7:", "walls[0].release.perimeter: ", "three"});
    hill.refused(wall("perimeter: [[0.2, 0.2], [0.8, 0.2], [0.5, 0.8]]", level),
                 {"walls[0].release.perimeter: no node of the terrain lies within it"});
    hill.refused(wall(kSquare, ""), {"walls[0].release.planes: "});
    hill.refused(wall(kSquare, "{point: [0, 0, 500], dip: 0}"),
                 {"walls[0].release.planes: the terrain lies nowhere above"});
    hill.refused(wall(kSquare, "{point: [0, 0, 70], dip: 95 deg}"), {"walls[0].release.planes[0].dip"});
    hill.refused(wall(kSquare, level) + bodies("size: {distribution: fixed, diameter: 1}, count: 1000000"),
                 {"test.yaml:9:", "bodies[0].count: 1000000 bodies do not fit: only "});
    hill.refused(wall(kSquare, level) + bodies("size: {distribution: fixed, diameter: 1}, solid_fraction: 0.73"),
                 {"bodies[0].solid_fraction: 0.73 is not reached", "(solid fraction 0."});
    hill.refused(wall(kSquare, level) + bodies("size: {distribution: fixed, diameter: 30}"), {"not one body fits"});
    hill.refused(wall(kSquare, level) + bodies("size: {distribution: fixed, diameter: 1 mm}"), {"are too small"});
    hill.refused(wall(kSquare, level) + bodies("count: 10"), {"bodies[0]", "size"});
    hill.refused("walls: [{shape: terrain, name: hill, material: steel, path: hill.asc}]\n" +
                     bodies("size: {distribution: fixed, diameter: 1}"),
                 {"bodies[0].wall: wall 'hill' has no `release`"});
    hill.refused("walls: [{shape: plane, name: hill, material: steel, point: [0, 0, 0], normal: [0, 0, 1]}]\n" +
                     bodies("size: {distribution: fixed, diameter: 1}"),
                 {"bodies[0].wall: wall 'hill' has no `release`"});
    hill.folder.write("hill.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    hill.refused("walls:\n  - {shape: terrain, name: hill, material: steel, path: hill.off, release: {" +
                     std::string(kSquare) + ", planes: [" + level + "]}}\n",
                 {"walls[0].release: is for grids of heights"});
}

}  // namespace
}  // namespace scree
