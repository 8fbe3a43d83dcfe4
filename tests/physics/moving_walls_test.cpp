// Walls with a prescribed motion, gravity that changes: the work that they do is what the ledger says.
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

// A platform lifts a ball at constant speed: work = m g height, once the ball has its speed (1/2 m V^2, and the plastic
// impact that gives it loses as much).
TEST(Piston, LiftsABall) {
    World w(1e-3);
    w.add(Vec3(0, 0, kRadius), kRadius);
    WallMotion up;
    up.velocity = Vec3(0, 0, 0.5);
    w.add_wall(PlaneWall{Vec3::Zero(), Vec3::UnitZ()}, up);
    w.run(1000);
    const double m = w.mass();
    EXPECT_NEAR(w.velocity().z(), 0.5, 1e-12);
    EXPECT_NEAR(w.position().z(), kRadius + 0.5, 0.5 * 1e-3);  // the impact falls inside the first step
    EXPECT_NEAR(w.state.ledger[Work::walls], m * kGravity * 0.5 + m * 0.25, 1e-3 * m * kGravity * 0.5);
    EXPECT_NEAR(w.state.ledger[Work::restitution], -0.125 * m, 1e-2 * m);
    EXPECT_LT(w.state.ledger.drift(), 1e-12);
    EXPECT_LT(w.state.totals.momentum_error_max, 1e-12);
}

// An elastic ball meets a wall that comes with V: it leaves with v + 2 V.
TEST(Piston, ElasticBallGainsTwiceTheSpeedOfTheWall) {
    World w(1e-3, 0.0, 1.0);
    w.gravity(Vec3::Zero());
    w.add(Vec3(1, 0, 0), kRadius, Vec3(-3, 0, 0));
    WallMotion come;
    come.velocity = Vec3(2, 0, 0);
    w.add_wall(PlaneWall{Vec3::Zero(), Vec3::UnitX()}, come);
    w.run(400);
    EXPECT_NEAR(w.velocity().x(), 7.0, 1e-12);
    EXPECT_NEAR(w.state.ledger[Work::walls], 0.5 * w.mass() * (49 - 9), 1e-10 * w.mass());
    EXPECT_LT(w.state.ledger.drift(), 1e-12);
}

// A conveyor belt: a sphere put on it slips, then rolls on the spot; friction on its surface cannot move its centre
// faster than 2/7 of the belt.
TEST(Belt, DragsASphereToTwoSevenths) {
    World w(1e-3, 0.3);
    w.add(Vec3(0, 0, kRadius), kRadius);
    WallMotion along;
    along.velocity = Vec3(1.4, 0, 0);
    w.add_wall(PlaneWall{Vec3::Zero(), Vec3::UnitZ()}, along);
    w.run(1000);
    // m v = J, 2/5 m R w = -J, v + R w' = V  =>  v = 2/7 V
    EXPECT_NEAR(w.velocity().x(), 0.4, 1e-11);
    EXPECT_NEAR(w.spin().y() * kRadius, -1.0, 1e-10);
    EXPECT_NEAR(w.state.ledger[Work::walls], w.mass() * 0.4 * 1.4, 1e-9 * w.mass());
    EXPECT_NEAR(w.state.ledger.kinetic, 0.5 * w.mass() * (0.16 + 0.4), 1e-9 * w.mass());
    EXPECT_LT(w.state.ledger.drift(), 1e-12);
}

// In a rotating drum a rolling sphere does not climb (it turns on the spot); one that cannot spin freely would.
// The drum's surface speed is the sphere's.
TEST(Drum, ASphereRollsAtTheBottom) {
    World w(1e-4, 0.5);
    const double drum = 1.0, rate = 2.0;
    w.add(Vec3(0, 0, -(drum - kRadius)), kRadius);
    WallMotion turn;
    turn.axis = Vec3::UnitY();
    turn.rate = rate;
    w.add_wall(CylinderWall{Vec3(0, -1, 0), Vec3::UnitY(), drum, 2.0, true}, turn);
    w.run(1000);
    // dragged while it slips: mu g t; the drum's lowest point moves towards -x (y x -z = -x)
    EXPECT_LT(w.velocity().x(), 0.0);
    EXPECT_LT(w.state.ledger.drift(), 1e-10);
    EXPECT_GT(w.state.ledger[Work::walls], 0.0);
    w.run(2000);
    const Vec3 centre = w.position(), surface = Vec3(0, rate, 0).cross(centre.normalized() * drum);
    const Vec3 point = w.velocity() + w.spin().cross(kRadius * centre.normalized());
    EXPECT_LT((point - surface).norm(), 5e-3 * surface.norm());  // no slip but for the contact found at mid-step
    EXPECT_LT(w.state.ledger.drift(), 1e-10);
}

TEST(ShakingFloor, LedgerCloses) {
    World w(1e-3, 0.3, 0.5);
    for (int i = 0; i < 5; ++i) w.add(Vec3(0.05 * i, 0.03 * i, kRadius * (1 + 2.1 * i)), kRadius);
    WallMotion shake;
    shake.amplitude = Vec3(0.01, 0, 0.05);
    shake.frequency = 5.0;
    w.add_wall(PlaneWall{Vec3::Zero(), Vec3::UnitZ()}, shake);
    w.add_wall(BoxWall{Vec3(-0.3, -0.3, -1), Vec3(0.6, 0.6, 9), true, true, true});
    w.run(1000);
    EXPECT_GT(std::abs(w.state.ledger[Work::walls]), 0.0);
    EXPECT_LT(w.state.ledger.drift(), 1e-10);
    EXPECT_LT(w.state.totals.momentum_error_max, 1e-12);
}

// Gravity that turns: the potential energy changes with it, and the ledger has it.
TEST(ChangingGravity, LedgerClosesAndFlightIsTheIntegral) {
    World w(1e-3, 0.3, 0.5);
    w.scene.gravity = TimeTable{{0.1, 0.5, 0.7}, {Vec3(0, 0, -10), Vec3(4, 0, -6), Vec3(0, 2, -10)}};
    w.add(Vec3(0, 0, 5), kRadius);
    w.add(Vec3(0.3, 0, kRadius), kRadius);
    w.add_floor();
    w.run(500);
    // velocity: the table's integral, by trapezia exactly; the midpoint of each step is exact for a linear function
    EXPECT_LT((w.velocity(0) - Vec3(4 * 0.4 / 2, 0, -10 * 0.5 + 4 * 0.4 / 2)).norm(), 1e-12);
    EXPECT_LT(w.state.ledger.drift(), 1e-10);
    w.run(1000);  // it bounces too
    EXPECT_LT(w.state.ledger.drift(), 1e-10);
    EXPECT_NE(w.state.ledger[Work::gravity], 0.0);
}

// The same in substeps: a fast body makes the step be cut.
TEST(ChangingGravity, LedgerClosesInSubsteps) {
    World w(1e-2, 0.0, 0.5);
    w.scene.gravity = TimeTable{{0.0, 0.5}, {Vec3(0, 0, -10), Vec3(4, 0, -30)}};
    w.add(Vec3(0, 0, 0.5), 0.01, Vec3(0, 0, -20));
    w.add(Vec3(0.02, 0, 0.5), 0.02);
    w.add_floor();
    w.run(60);
    EXPECT_GT(w.state.totals.substepped, 10U);
    EXPECT_GT(w.state.totals.steps, 60U);
    EXPECT_LT(w.state.ledger.drift(), 1e-10);
}

}  // namespace
}  // namespace scree
