#include "solvers/rasters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "solvers/runout.hpp"
#include "tests/testing/height_grid.hpp"
#include "tests/testing/hull_shape.hpp"
#include "tests/testing/small_scene.hpp"

namespace scree::solvers {
namespace {

using namespace scree::testing;

RasterSettings cells(std::uint32_t columns, std::uint32_t rows, double size) {
    RasterSettings rasters;
    rasters.grid = {columns, rows, 0.0, 0.0, size, size};
    return rasters;
}

double volume(double radius) {
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

TEST(Rasters, KeepTheLargestOfEachCell) {
    SmallScene w(0.1);
    w.scene.rasters = cells(4, 3, 10.0);
    w.scene.rasters->sample_every = 2;
    w.scene.rasters->level = -1.0;
    w.add(Vec3(15.0, 25.0, 2.0), 0.5, Vec3(3.0, 0.0, -4.0));
    Rasters rasters(w.scene, Communicator::self());
    rasters.start(w.scene, w.state);
    const std::size_t first = 2 * 4 + 1, next = 2 * 4 + 2;
    const double depth = volume(0.5) / 100.0;
    const RasterState& kept = w.state.rasters;
    EXPECT_NEAR(kept.depth[first], depth, 1e-10);
    EXPECT_DOUBLE_EQ(kept.height[first], 3.5);
    EXPECT_DOUBLE_EQ(kept.speed[first], 5.0);
    EXPECT_EQ(kept.arrival[first], 0.0);
    EXPECT_EQ(kept.arrival[next], RasterState::kNever);
    // A step between samples leaves no trace.
    w.position() = Vec3(25.0, 25.0, 9.0);
    w.state.step = 1, w.state.time = 0.1;
    rasters.after_step(w.scene, w.state);
    EXPECT_EQ(kept.arrival[next], RasterState::kNever);
    w.state.step = 2, w.state.time = 0.2;
    w.velocity() = Vec3(0.0, 1.0, 0.0);
    rasters.after_step(w.scene, w.state);
    EXPECT_EQ(kept.arrival[next], 0.2);
    EXPECT_DOUBLE_EQ(kept.speed[next], 1.0);
    EXPECT_DOUBLE_EQ(kept.height[next], 10.5);
    EXPECT_DOUBLE_EQ(kept.speed[first], 5.0);
    // The last step of a run counts.
    w.state.step = 3;
    w.velocity() = Vec3(0.0, 2.0, 0.0);
    rasters.after_step(w.scene, w.state);
    EXPECT_DOUBLE_EQ(kept.speed[next], 1.0);
    rasters.finish(w.scene, w.state);
    EXPECT_DOUBLE_EQ(kept.speed[next], 2.0);
    // The deposit is what lies there now.
    const std::vector<double> deposit = rasters.depth(w.scene, w.state);
    EXPECT_EQ(deposit[first], 0.0);
    EXPECT_NEAR(deposit[next], depth, 1e-10);
}

TEST(Rasters, ArrivalIsWhenTheDepthPassesTheLimit) {
    SmallScene w(0.1);
    w.scene.rasters = cells(1, 1, 10.0);
    w.scene.rasters->covered = 1.5 * volume(0.5) / 100.0;
    w.add(Vec3(5.0, 5.0, 0.0), 0.5);
    Rasters rasters(w.scene, Communicator::self());
    rasters.start(w.scene, w.state);
    EXPECT_EQ(w.state.rasters.arrival[0], RasterState::kNever);
    w.add(Vec3(5.0, 6.0, 0.0), 0.5);
    w.state.step = 1, w.state.time = 0.1;
    rasters.after_step(w.scene, w.state);
    EXPECT_EQ(w.state.rasters.arrival[0], 0.1);
}

// However large the cells are against the bodies, and whatever the share of pores.
TEST(Rasters, DepthTimesAreaIsTheVolume) {
    for (const double size : {0.01, 0.1, 0.33, 2.0}) {
        for (const double solid : {1.0, 0.6}) {
            SmallScene w(0.1);
            const auto n = static_cast<std::uint32_t>(std::ceil(4.0 / size));
            w.scene.rasters = cells(n, n + 1, size);
            w.scene.rasters->solid_fraction = solid;
            Random random(1, 2, 3);
            double sum = 0.0;
            for (int i = 0; i < 60; ++i) {
                const double r = random.uniform(0.01, 0.2);
                w.add(Vec3(random.uniform(0.5, 3.5), random.uniform(0.5, 3.5), 0.0), r);
                sum += volume(r);
            }
            Rasters rasters(w.scene, Communicator::self());
            double depths = 0.0;
            for (const double d : rasters.depth(w.scene, w.state)) depths += d;
            EXPECT_NEAR(depths * size * size * solid, sum, 1e-9 * sum) << size;
        }
    }
}

TEST(Rasters, BodiesBesideTheGridCountForNothing) {
    SmallScene w(0.1);
    w.scene.rasters = cells(2, 2, 1.0);
    for (const Vec3& x : {Vec3(-1, 1, 0), Vec3(3, 1, 0), Vec3(1, -1, 0), Vec3(1, 3, 0), Vec3(1e9, -1e9, 0)})
        w.add(x, 0.1);
    Rasters rasters(w.scene, Communicator::self());
    for (const double d : rasters.depth(w.scene, w.state)) EXPECT_EQ(d, 0.0);
    w.position(0) = Vec3(0.0, 0.5, 0.0);  // half of it is inside
    EXPECT_NEAR(rasters.depth(w.scene, w.state)[0], 0.5 * volume(0.1), 1e-11);
}

TEST(Rasters, NothingIsKeptUnlessAsked) {
    SmallScene w(0.1);
    w.add(Vec3::Zero(), 0.1);
    Rasters rasters(w.scene, Communicator::self());
    rasters.start(w.scene, w.state);
    rasters.after_step(w.scene, w.state);
    EXPECT_EQ(w.state.rasters.columns, 0U);
    EXPECT_TRUE(w.state.rasters.depth.empty());
}

TEST(Rasters, HeightsAreAboveTheTerrain) {
    SmallScene w(0.1);
    const auto slope = [](double x, double y) { return 100.0 - 0.5 * x + 0.25 * y; };
    w.add_wall(wall_of(height_grid(9, 7, 10.0, 10.0, slope)));
    w.scene.rasters = cells(8, 6, 10.0);
    w.scene.rasters->terrain = WallIndex{0};
    Random random(3, 0, 0);
    for (int i = 0; i < 50; ++i) {
        const double x = random.uniform(0.0, 80.0), y = random.uniform(0.0, 60.0);
        EXPECT_NEAR(ground_height(w.scene, *w.scene.rasters, x, y), slope(x, y), 1e-10);
    }
    EXPECT_TRUE(std::isnan(ground_height(w.scene, *w.scene.rasters, -1.0, 5.0)));
    w.add(Vec3(33.0, 22.0, slope(33.0, 22.0) + 3.0), 1.0);
    Rasters rasters(w.scene, Communicator::self());
    rasters.start(w.scene, w.state);
    EXPECT_NEAR(w.state.rasters.height[2 * 8 + 3], 4.0, 1e-9);
}

TEST(Rasters, ThePolyhedronsHighestCornerCounts) {
    SmallScene w(0.1);
    w.add(Vec3(0.0, 0.0, 5.0), 1.0);
    w.state.shapes = {box_shape({2.0, 4.0, 6.0})};
    w.state.bodies.shape = {ShapeIndex{0}};
    w.state.bodies.orientation = {Quat::Identity()};
    EXPECT_NEAR(highest_point(w.state, 0), 8.0, 1e-12);
    w.state.bodies.orientation = {Quat(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()))};
    EXPECT_NEAR(highest_point(w.state, 0), 7.0, 1e-12);
    w.state.bodies.shape = {kSphere};
    EXPECT_DOUBLE_EQ(highest_point(w.state, 0), 6.0);
}

TEST(Runout, IsFromTheCrestToTheFarthestCoveredCell) {
    SmallScene w(0.1);
    w.scene.origin = Vec3(1000.0, 2000.0, 300.0);
    w.scene.rasters = cells(20, 1, 10.0);
    w.scene.rasters->level = -2.0;
    w.add(Vec3(5.0, 5.0, 60.0), 1.0);
    w.add(Vec3(15.0, 5.0, 40.0), 2.0);
    Rasters rasters(w.scene, Communicator::self());
    rasters.start(w.scene, w.state);
    w.position(0) = Vec3(95.0, 5.0, 0.0);
    w.position(1) = Vec3(195.0, 5.0, 0.0);
    w.state.step = 1;
    rasters.after_step(w.scene, w.state);
    const std::vector<double> deposit = rasters.depth(w.scene, w.state);
    const Runout r = runout(w.scene, w.state, deposit, Communicator::self());
    EXPECT_NEAR((r.top - Vec3(1005.0, 2005.0, 361.0)).norm(), 0.0, 1e-9);
    EXPECT_NEAR((r.toe - Vec3(1195.0, 2005.0, 298.0)).norm(), 0.0, 1e-9);
    EXPECT_NEAR(r.fall_height, 63.0, 1e-9);
    EXPECT_NEAR(r.length, 190.0, 1e-9);
    // Masses 1 : 8.
    EXPECT_NEAR(r.centre_before.x(), 1000.0 + (5.0 + 8.0 * 15.0) / 9.0, 1e-9);
    EXPECT_NEAR(r.centre_fall, (60.0 + 8.0 * 40.0) / 9.0, 1e-9);
    EXPECT_NEAR(r.centre_length, (90.0 + 8.0 * 180.0) / 9.0, 1e-9);
    EXPECT_NEAR(r.released_volume, 9.0 * volume(1.0), 1e-9);
    EXPECT_NEAR(r.deposit_area, 200.0, 1e-9);
    EXPECT_NEAR(r.flowed_area, 400.0, 1e-9);
    EXPECT_NEAR(r.deposit_volume, 9.0 * volume(1.0), 1e-6);
    EXPECT_NEAR(r.deposit_most, 8.0 * volume(1.0) / 100.0, 1e-9);
    // Single blocks that are no cover do not count.
    w.scene.rasters->covered = 2.0 * volume(1.0) / 100.0;
    w.position(0) = Vec3(195.0, 5.0, 0.0);
    w.position(1) = Vec3(95.0, 5.0, 0.0);
    EXPECT_NEAR(runout(w.scene, w.state, rasters.depth(w.scene, w.state), Communicator::self()).length, 90.0, 1e-9);
}

TEST(Runout, WithoutAReleaseHasNoLength) {
    SmallScene w(0.1);
    w.scene.rasters = cells(2, 2, 1.0);
    Rasters rasters(w.scene, Communicator::self());
    rasters.start(w.scene, w.state);
    w.add(Vec3(1.0, 1.0, 1.0), 0.1);  // from an inlet
    const Runout r = runout(w.scene, w.state, rasters.depth(w.scene, w.state), Communicator::self());
    EXPECT_TRUE(std::isnan(r.length));
    EXPECT_TRUE(std::isnan(r.top.x()));
    EXPECT_TRUE(std::isnan(r.centre_length));
    EXPECT_EQ(r.deposit_area, 4.0);
}

TEST(Runout, WithoutADepositHasNoLength) {
    SmallScene w(0.1);
    w.scene.rasters = cells(2, 2, 1.0);
    w.add(Vec3(1.0, 1.0, 1.0), 0.1);
    Rasters rasters(w.scene, Communicator::self());
    rasters.start(w.scene, w.state);
    w.position() = Vec3(9.0, 0.0, -1e6);  // fell off
    const Runout r = runout(w.scene, w.state, rasters.depth(w.scene, w.state), Communicator::self());
    EXPECT_NEAR(r.beyond, volume(0.1), 1e-12);
    EXPECT_TRUE(std::isnan(r.length));
    EXPECT_EQ(r.deposit_area, 0.0);
}

}  // namespace
}  // namespace scree::solvers
