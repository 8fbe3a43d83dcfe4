// The local origin: a scene far away is the same scene.
#include <fmt/format.h>

#include <cmath>

#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

using testing::build_good;
using testing::kHead;
using testing::TemporaryFolder;

std::string vector(const Vec3& v) {
    return fmt::format("[{:.12f}, {:.12f}, {:.12f}]", v.x(), v.y(), v.z());
}

std::string scene_at(const Vec3& s) {
    const auto at = [&](double x, double y, double z) { return vector(Vec3(x, y, z) + s); };
    return kHead + "bodies:\n" +
           "  - {generator: sphere, material: glass, radius: 0.1, position: " + at(0.3, 0.2, 2.5) + "}\n" +
           "  - {generator: lattice, material: glass, pitch: 0.11, cells: [5, 5, 5], jitter: 0.004, count: 90, "
           "corner: " +
           at(-0.25, -0.25, 1.0) + ", size: {distribution: uniform, lower: 0.08, upper: 0.1},\n     clip: " +
           "{shape: cylinder, base: " + at(0, 0, 0) + ", radius: 0.3, length: 3}}\n" +
           "  - {generator: random, material: steel, size: {distribution: fixed, diameter: 0.1}, count: 50,\n     "
           "region: " +
           "{shape: box, lower: " + at(-0.5, -0.5, 0) + ", upper: " + at(0.5, 0.5, 0.9) + "}}\n" +
           "  - {generator: file, material: glass, path: bodies.txt, offset: " + vector(s) + "}\n" + "walls:\n" +
           "  - {shape: plane, name: p, material: glass, point: " + at(0, 0, 0.05) + ", normal: [0, 0, 1],\n" +
           "     motion: {rate: 1, centre: " + at(0, 0, 1) + "}}\n" +
           "  - {shape: cylinder, name: c, material: glass, base: " + at(0, 0, 0) + ", radius: 0.8, length: 3}\n" +
           "outlets:\n  - {name: o, region: {shape: half_space, normal: [0, 0, 1], point: " + at(0, 0, -1) + "}}\n" +
           "inlets:\n  - {name: i, material: glass, size: {distribution: fixed, diameter: 0.1}, mass_rate: 1,\n" +
           "     region: {shape: box, lower: " + at(0, 0, 3) + ", upper: " + at(1, 1, 4) + "}}\n" + "measures:\n" +
           fmt::format("  - {{measure: profile, name: m, lower: {:.12f}, upper: {:.12f}, bins: 10}}\n", s.z(),
                       s.z() + 2.0) +
           "  - {measure: flow_rate, name: q, normal: [0, 0, -1], point: " + at(0, 0, 0.5) + "}\n";
}

TEST(Origin, AMovedSceneIsTheSameScene) {
    const TemporaryFolder folder;
    folder.write("bodies.txt", "0.1 -0.2 2 0.03\n-0.1 0.1 2.2 0.03\n");
    const scenarios::Built here = build_good(scene_at(Vec3::Zero()), folder.path());
    const Vec3 shift(538500, 5576504, 2000);
    const scenarios::Built there = build_good(scene_at(shift), folder.path());
    EXPECT_EQ(here.scene.origin, Vec3::Zero());
    EXPECT_NE(there.scene.origin, Vec3::Zero());

    const Vec3 back = there.scene.origin - shift;  // exact: both are whole metres
    ASSERT_LT(back.norm(), 20.0);
    const Bodies &a = here.state.bodies, &b = there.state.bodies;
    ASSERT_EQ(a.size(), 143U);
    ASSERT_EQ(b.size(), a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_LT((b.position[i] + back - a.position[i]).cwiseAbs().maxCoeff(), 1e-9) << i;
        EXPECT_EQ(a.radius[i], b.radius[i]);
        EXPECT_EQ(a.mass[i], b.mass[i]);
    }
    const auto same = [&](const Vec3& x, const Vec3& y) { EXPECT_LT((y + back - x).norm(), 1e-8); };
    same(std::get<PlaneWall>(here.scene.walls[0].shape).point, std::get<PlaneWall>(there.scene.walls[0].shape).point);
    same(here.scene.walls[0].motion.centre, there.scene.walls[0].motion.centre);
    same(std::get<CylinderWall>(here.scene.walls[1].shape).base,
         std::get<CylinderWall>(there.scene.walls[1].shape).base);
    same(std::get<HalfSpaceRegion>(here.scene.outlets[0].region).point,
         std::get<HalfSpaceRegion>(there.scene.outlets[0].region).point);
    same(here.scene.inlets[0].region.upper, there.scene.inlets[0].region.upper);
    same(here.scene.measures[1].surface.point, there.scene.measures[1].surface.point);
    EXPECT_NEAR(there.scene.measures[0].from_coordinate + back.z(), here.scene.measures[0].from_coordinate, 1e-8);
}

// The origin is a multiple of a power of two not below the last digit of the coordinates: origin + local gives back
// every coordinate to the bit.
TEST(Origin, TakingItLosesNoDigit) {
    const TemporaryFolder folder;
    folder.write("bodies.txt", "5576504.123456789 -538500.987654321 2000.3 0.5\n5576505.9 -538499.1 2001.7 0.5\n");
    const scenarios::Built built =
        build_good(kHead + "bodies:\n  - {generator: file, material: glass, path: bodies.txt}\n", folder.path());
    const Vec3 back = built.scene.origin + built.state.bodies.position[0];
    EXPECT_EQ(back, Vec3(5576504.123456789, -538500.987654321, 2000.3));
    EXPECT_LT(built.state.bodies.position[0].norm(), 10.0);
}

TEST(Origin, CanBeGiven) {
    const scenarios::Built built =
        build_good(kHead +
                   "origin: [1, 2, 3]\nbodies:\n"
                   "  - {generator: sphere, material: glass, position: [1, 2, 4], radius: 0.1}\n");
    EXPECT_EQ(built.scene.origin, Vec3(1, 2, 3));
    EXPECT_EQ(built.state.bodies.position[0], Vec3(0, 0, 1));
}

TEST(Origin, OfAResumedSceneNeedsNoFileOfBodies) {
    io::Diagnostics diagnostics;
    const TemporaryFolder folder;
    folder.write("bodies.txt", "1000000 0 0 0.5\n");
    const std::string text = kHead + "bodies:\n  - {generator: file, material: glass, path: bodies.txt}\n";
    const io::ReadResult read = io::read_scenario_text(text, folder.path() + "/test.yaml", {}, diagnostics);
    ASSERT_FALSE(diagnostics.has_errors());
    const Vec3 first = scenarios::build(read.root, folder.path(), diagnostics).scene.origin;
    EXPECT_NEAR(first.x(), 1e6, 2.0);
    EXPECT_EQ(scenarios::build_scene(read.root, folder.path(), diagnostics).origin, first);
    std::filesystem::remove(folder.path() + "/bodies.txt");
    EXPECT_EQ(scenarios::build_scene(read.root, folder.path(), diagnostics, first).origin, first);
    EXPECT_FALSE(diagnostics.has_errors());
}

}  // namespace
}  // namespace scree
