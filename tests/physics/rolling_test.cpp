// A sphere on a plane: rolling and sliding down, sliding to rolling, spinning on the spot.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/testing/closed_forms.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::kGravity;
using testing::World;

constexpr double kRadius = 0.1;
constexpr double kDegree = std::numbers::pi / 180.0;

// On a floor under gravity that leans by `angle`, so that x is downhill; the contact point is exact.
void on_slope(World& w, double angle, const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero()) {
    w.gravity(kGravity * Vec3(std::sin(angle), 0.0, -std::cos(angle)));
    w.add(Vec3(0, 0, kRadius), kRadius, velocity, spin);
    w.add_floor();
}

TEST(Incline, RollsWithFiveSeventhsOfGravity) {
    for (const double mu : {0.1650, 0.3, 10.0}) {  // 2/7 tan 30 deg = 0.164957
        World w(1e-3, mu);
        on_slope(w, 30 * kDegree);
        w.run(1000);
        const double a = 5.0 / 7.0 * kGravity * std::sin(30 * kDegree);
        EXPECT_NEAR(w.velocity().x(), a, 1e-10 * a);  // constant forces: exact but for the solver's 1e-13
        EXPECT_NEAR(w.spin().y() * kRadius, a, 1e-10 * a);
        EXPECT_NEAR(w.position().x(), 0.5 * a, 1e-10 * a);
        EXPECT_LT(w.state.ledger.drift(), 1e-10);
        EXPECT_NEAR(w.state.ledger[Work::friction], 0.0, 1e-10 * w.state.ledger.kinetic);  // rolling loses nothing
    }
}

TEST(Incline, SlidesBelowTheLeastFrictionForRolling) {
    for (const double mu : {0.1, 0.1649}) {
        World w(1e-3, mu);
        on_slope(w, 30 * kDegree);
        w.run(1000);
        const double a = kGravity * (std::sin(30 * kDegree) - mu * std::cos(30 * kDegree));
        const double surface = 2.5 * mu * kGravity * std::cos(30 * kDegree);
        EXPECT_NEAR(w.velocity().x(), a, 1e-10 * a);
        EXPECT_NEAR(w.spin().y() * kRadius, surface, 1e-10 * a);
        EXPECT_LT(w.spin().y() * kRadius, w.velocity().x());
        EXPECT_LT(w.state.ledger.drift(), 1e-10);
        EXPECT_LT(w.state.ledger[Work::friction], 0.0);
    }
}

// The incline as a wall that leans instead of gravity that does.
TEST(Incline, ALeaningPlaneIsTheSameAsLeaningGravity) {
    World w(1e-3, 0.3);
    const Vec3 normal(std::sin(0.5), 0, std::cos(0.5));
    w.add(kRadius * normal, kRadius);
    w.add_wall(PlaneWall{Vec3::Zero(), normal});
    w.run(1000);
    const double a = 5.0 / 7.0 * kGravity * std::sin(0.5);
    EXPECT_NEAR(w.velocity().norm(), a, 1e-10 * a);
    EXPECT_NEAR(w.velocity().dot(normal), 0.0, 1e-12);
    EXPECT_NEAR(w.position().dot(normal), kRadius, 1e-12);
}

struct Start {
    double velocity, surface, end;  // v0, R omega0, final v [m/s]
};

// Angular momentum about the contact point is conserved: 5/7 v0 + 2/7 R omega0, whatever the step and the friction.
TEST(SlidingToRolling, FinalVelocityIsExact) {
    for (const Start& s : {Start{5, 0, 25.0 / 7}, Start{5, 10, 45.0 / 7}, Start{5, -12.5, 0}, Start{5, -20, -15.0 / 7}})
        for (const double h : {1e-3, 7e-3}) {
            World w(h, 0.3);
            on_slope(w, 0.0, Vec3(s.velocity, 0, 0), Vec3(0, s.surface / kRadius, 0));
            while (w.state.time < 3.0) w.step();
            EXPECT_NEAR(w.velocity().x(), s.end, 5e-10);  // 1e-10 of the start's 5 m/s
            EXPECT_NEAR(w.spin().y() * kRadius, s.end, 5e-10);
            EXPECT_NEAR(w.velocity().y(), 0.0, 1e-14);
            const double start = 0.5 * (s.velocity * s.velocity + 0.4 * s.surface * s.surface);
            const double loss = start - 0.5 * 1.4 * s.end * s.end;
            EXPECT_NEAR(-w.state.ledger[Work::friction] / w.mass(), loss, 1e-9 * start);
            EXPECT_LT(w.state.ledger.drift(), 1e-10);
        }
}

// Slips with -mu g for 2 v0 / 7 mu g over 12 v0^2 / 49 mu g. Velocity is exact while it slips; the end of slipping
// falls inside a step, where the position is off by at most mu g h^2 / 8.
TEST(SlidingToRolling, TimeAndDistanceOfSlipping) {
    const double mu = 0.3, v0 = 5.0, h = 1e-3, end = 2.0 * v0 / (7.0 * mu * kGravity);
    World w(h, mu);
    on_slope(w, 0.0, Vec3(v0, 0, 0));
    while (w.state.time < end - h) {
        w.step();
        ASSERT_NEAR(w.velocity().x(), v0 - mu * kGravity * w.state.time, 1e-11);
        ASSERT_GT(w.velocity().x(), w.spin().y() * kRadius);
    }
    w.run(2);
    EXPECT_NEAR(w.velocity().x(), w.spin().y() * kRadius, 1e-11);
    const double slipped = 12.0 * v0 * v0 / (49.0 * mu * kGravity);
    EXPECT_NEAR(w.position().x(), slipped + 5.0 / 7.0 * v0 * (w.state.time - end), mu * kGravity * h * h / 8.0 * 1.01);
}

TEST(Spin, OnOnePointGoesOnForEver) {
    World w(1e-3, 0.5);
    on_slope(w, 0.0, Vec3::Zero(), Vec3(0, 0, 20));
    w.run(3000);
    EXPECT_LT((w.spin() - Vec3(0, 0, 20)).norm(), 1e-13);  // no torque at all about the normal
    EXPECT_LT(w.velocity().norm(), 1e-14);
}

TEST(Spin, BetweenTwoSpheresStaysToo) {
    World w(1e-3, 0.5);
    w.gravity(Vec3::Zero());
    w.add(Vec3(0, 0, 0), kRadius, Vec3(0, 0, 1), Vec3(0, 0, 7));
    w.add(Vec3(0, 0, 2 * kRadius), kRadius, Vec3(0, 0, -1), Vec3(0, 0, -3));
    w.run(10);
    EXPECT_LT((w.spin(0) - Vec3(0, 0, 7)).norm(), 1e-14);  // the solver holds R omega
    EXPECT_LT((w.spin(1) - Vec3(0, 0, -3)).norm(), 1e-14);
    EXPECT_NEAR(w.velocity(0).z(), 0.0, 1e-13);
}

}  // namespace
}  // namespace scree
