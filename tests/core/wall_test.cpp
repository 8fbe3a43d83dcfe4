#include "core/wall.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scree {
namespace {

WallMotion every_motion() {
    WallMotion m;
    m.velocity = Vec3(0.3, -0.2, 0.1);
    m.amplitude = Vec3(0.01, 0.0, 0.02);
    m.frequency = 3.0;
    m.phase = 0.4;
    m.centre = Vec3(1, 2, 3);
    m.axis = Vec3(1, 1, -1).normalized();
    m.rate = 2.5;
    m.start = 0.2;
    m.end = 1.7;
    return m;
}

TEST(WallMotion, RestsBeforeStartAndAfterEnd) {
    const WallMotion m = every_motion();
    EXPECT_TRUE(pose_at(m, 0.0).to_world(Vec3(4, 5, 6)).isApprox(Vec3(4, 5, 6), 1e-15));
    EXPECT_TRUE(pose_at(m, 0.2).to_world(Vec3(4, 5, 6)).isApprox(Vec3(4, 5, 6), 1e-15));
    EXPECT_EQ(pose_at(m, 1.7).to_world(Vec3(4, 5, 6)), pose_at(m, 9.0).to_world(Vec3(4, 5, 6)));
    EXPECT_TRUE(mean_velocity(m, Vec3(4, 5, 6), 0.0, 0.1).isZero(0.0));
    EXPECT_TRUE(mean_velocity(m, Vec3(4, 5, 6), 2.0, 0.1).isZero(0.0));
}

TEST(WallMotion, PoseFollowsItsFormula) {
    WallMotion m;
    m.axis = Vec3::UnitZ();
    m.centre = Vec3(1, 0, 0);
    m.rate = std::numbers::pi / 2;
    m.velocity = Vec3(0, 0, 2);
    const WallPose pose = pose_at(m, 1.0);
    EXPECT_TRUE(pose.to_world(Vec3(2, 0, 0)).isApprox(Vec3(1, 1, 2), 1e-15));
    EXPECT_TRUE(pose.to_local(Vec3(1, 1, 2)).isApprox(Vec3(2, 0, 0), 1e-15));
}

// The mean velocity is the displacement of the material point between the two poses, over the step; also over a step
// that holds the start or the end of the motion.
TEST(WallMotion, MeanVelocityIsTheDisplacementOfTheMaterialPoint) {
    const WallMotion m = every_motion();
    const Vec3 world(3, -1, 2);
    for (const double step : {1e-3, 0.1}) {
        for (const double time : {0.15, 0.2 - 0.3 * step, 0.9, 1.7 - 0.6 * step}) {
            const Vec3 local = pose_at(m, time + 0.5 * step).to_local(world);
            const Vec3 moved = pose_at(m, time + step).to_world(local) - pose_at(m, time).to_world(local);
            EXPECT_LT((mean_velocity(m, world, time, step) - moved / step).norm(), 1e-14 / step) << time;
        }
    }
}

// Far from the origin the difference of two positions would have lost its digits.
TEST(WallMotion, MeanVelocityOfASlowWallKeepsItsDigits) {
    WallMotion m;
    m.axis = Vec3::UnitZ();
    m.rate = 1e-9;
    m.centre = Vec3(1e6, 0, 0);
    const Vec3 v = mean_velocity(m, Vec3(1e6 + 1.0, 0, 0), 0.0, 1e-4);
    EXPECT_NEAR(v.y() / 1e-9, 1.0, 1e-14);
}

TEST(WallMotion, AWallWithoutMotionDoesNotMove) {
    EXPECT_FALSE(WallMotion{}.moves());
    EXPECT_TRUE(pose_at(WallMotion{}, 5.0).rotation.isIdentity(0.0));
    EXPECT_TRUE(every_motion().moves());
}

TEST(Wall, IsPresentFromAppearsUntilGoes) {
    Wall wall;
    wall.appears = 0.1;
    wall.goes = 0.4;
    EXPECT_FALSE(wall.present(0.0999));
    EXPECT_TRUE(wall.present(0.1));
    EXPECT_TRUE(wall.present(0.3999));
    EXPECT_FALSE(wall.present(0.4));
}

TEST(Wall, TranslationMovesShapeAndPivot) {
    Wall wall;
    wall.shape = BoxWall{Vec3(0, 0, 0), Vec3(1, 1, 1), true, false, false};
    wall.motion.centre = Vec3(0.5, 0.5, 0.5);
    const Wall moved = translated(wall, Vec3(10, 20, 30));
    EXPECT_EQ(std::get<BoxWall>(moved.shape).lower, Vec3(10, 20, 30));
    EXPECT_EQ(std::get<BoxWall>(moved.shape).upper, Vec3(11, 21, 31));
    EXPECT_EQ(moved.motion.centre, Vec3(10.5, 20.5, 30.5));
}

}  // namespace
}  // namespace scree
