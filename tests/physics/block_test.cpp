// A block on a plane: sticking, sliding, stopping, tipping, spinning on the spot.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/testing/closed_forms.hpp"
#include "tests/testing/solids.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::box;
using testing::cube;
using testing::kGravity;
using testing::World;

constexpr double kDegree = std::numbers::pi / 180.0;

// On a floor under gravity that leans by `angle`, so that x is downhill.
void on_slope(World& w, const Vec3& sides, double angle, const Vec3& velocity = Vec3::Zero(),
              const Vec3& spin = Vec3::Zero()) {
    w.gravity(kGravity * Vec3(std::sin(angle), 0.0, -std::cos(angle)));
    w.add(box(sides), Vec3(0, 0, 0.5 * sides.z()), Quat::Identity(), velocity, spin);
    w.add_floor();
}

TEST(Block, SlidesAtTheRateOfThePlane) {
    World w(1e-3, 0.3);
    on_slope(w, Vec3(0.4, 0.3, 0.1), 30 * kDegree);
    w.run(1000);
    const double a = kGravity * (std::sin(30 * kDegree) - 0.3 * std::cos(30 * kDegree));
    EXPECT_NEAR(w.velocity().x(), a, 1e-9 * a);
    EXPECT_NEAR(w.position().x(), 0.5 * a, 1e-9 * a);
    EXPECT_LT(w.spin().norm(), 1e-10);
    EXPECT_LT(w.state.ledger.drift(), 1e-10);
}

TEST(Block, SticksJustBelowTheAngleOfFrictionAndSlidesJustAbove) {
    for (const double share : {1.0 - 1e-3, 1.0 + 1e-3}) {
        const double mu = 0.5, angle = std::atan(mu * share);
        World w(1e-3, mu);
        on_slope(w, Vec3(0.4, 0.4, 0.1), angle);
        w.run(10000);
        if (share < 1.0) {
            EXPECT_LT(std::abs(w.position().x()), 1e-6);
        } else {
            const double a = kGravity * (std::sin(angle) - mu * std::cos(angle));
            EXPECT_NEAR(w.velocity().x(), 10.0 * a, 1e-6 * a);
        }
    }
}

TEST(Block, StopsOnTheLevelAndStays) {
    World w(1e-3, 0.3);
    on_slope(w, Vec3(0.4, 0.4, 0.1), 0.0, Vec3(5, 0, 0));
    const double time = 5.0 / (0.3 * kGravity), way = 12.5 / (0.3 * kGravity);
    w.run(static_cast<int>(std::ceil(time / 1e-3)) + 1);
    EXPECT_LT(w.velocity().norm(), 1e-10);
    EXPECT_NEAR(w.position().x(), way, 0.3 * kGravity * 1e-6 / 8.0 + 1e-9);
    w.run(200);
    EXPECT_LT(w.velocity().norm(), 1e-10);
}

// mu above half-width over half-height: it tips, below: it slides.
TEST(Block, TipsOrSlides) {
    const double leans = std::atan(0.25) * 1.05;  // a block 4 times as high as wide tips at atan(1/4)
    World tall(1e-3, 0.5);
    on_slope(tall, Vec3(0.1, 0.4, 0.4), leans);
    tall.run(2000);
    EXPECT_GT(std::abs(tall.spin().y()) + tall.position().x(), 0.1);
    EXPECT_LT(tall.position().z(), 0.15);  // it lies

    World stands(1e-3, 0.5);
    on_slope(stands, Vec3(0.1, 0.4, 0.4), std::atan(0.25) * 0.95);
    stands.run(2000);
    EXPECT_LT(stands.velocity().norm(), 1e-9);
}

// d omega / dt = -3 sqrt(2) mu g / s of a cube on its four corners.
TEST(Block, ACubeSpinningOnTheFloorIsStoppedByItsCorners) {
    const double side = 0.1, mu = 0.3, spin = 20.0;
    const double time = spin * side / (3.0 * std::sqrt(2.0) * mu * kGravity);
    double last = 0.0;
    for (const double h : {1e-3, 1e-4}) {
        World w(h, mu);
        on_slope(w, Vec3::Constant(side), 0.0, Vec3::Zero(), Vec3(0, 0, spin));
        w.start();
        int steps = 0;
        while (w.spin().z() > 1e-6 && steps < 10000) {
            w.step();
            ++steps;
        }
        // the corners turn on by omega h / 2 in half a step
        EXPECT_NEAR(steps * h, time, 1.5 * h + 2e-3 * h / 1e-3 * time) << h;
        last = steps * h;
    }
    EXPECT_NEAR(last, 0.160178, 3e-4);
}

// A box that keeps bodies outside is felt on its faces, edges and corners.
TEST(Block, RestsOnAFixedBoxAndFallsOffItsEdge) {
    for (const double over : {0.04, 0.06}) {  // the centre beyond the edge by -1 cm or 1 cm
        World w(1e-3, 0.5);
        w.gravity(Vec3(0, 0, -kGravity));
        w.add(cube(0.1), Vec3(0.45 + over, 0.02, 1.05));
        w.add_wall(BoxWall{{-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0}, false, false, false});
        w.run(1500);
        EXPECT_LT(w.state.ledger.drift(), 1e-10);
        if (over < 0.05) {
            EXPECT_LT(w.velocity().norm(), 1e-10);
            EXPECT_NEAR(w.position().z(), 1.05, 1e-9);
        } else {
            EXPECT_LT(w.position().z(), 0.9);
            EXPECT_GT(w.spin().y(), 0.1);
        }
    }
}

}  // namespace
}  // namespace scree
