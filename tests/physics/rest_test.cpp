// Bodies at rest: forces in stacks, grooves and heaps, and that they stay where they are.
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

// Contact k from the top carries k m g. With the residual at 1e-13 of g h a contact and N contacts above each other,
// errors of impulses add up to at most N^2 times that.
TEST(Stack, ForcesAreTheWeightsAbove) {
    for (const double mu : {0.0, 0.5}) {
        World w(1e-3, mu);
        w.scene.output.contacts = true;
        const int n = 10;
        for (int i = 0; i < n; ++i) w.add(Vec3(0, 0, kRadius * (1 + 2 * i)), kRadius);
        const std::size_t floor = w.add_floor();
        w.run(50);
        ASSERT_TRUE(w.report.converged);
        const double weight = w.mass() * kGravity;
        ASSERT_EQ(w.stepper->contacts().size(), 10U);
        for (const ContactRecord& c : w.stepper->contacts()) {
            const double above = c.key.is_wall() ? n : n - 1 - static_cast<double>(c.key.a);
            EXPECT_NEAR(c.impulse.norm() / c.step / weight, above, 1e-10);
            EXPECT_NEAR(std::abs(c.impulse.z()) / c.step / weight, above, 1e-10);
        }
        const Vec3 load = w.stepper->wall_loads()[floor].impulse / w.stepper->last_step();
        EXPECT_NEAR(load.z() / weight, -n, 1e-10);
        for (int i = 0; i < n; ++i) {
            EXPECT_LT(w.velocity(static_cast<std::size_t>(i)).norm(), 1e-12);
            EXPECT_NEAR(w.position(static_cast<std::size_t>(i)).z(), kRadius * (1 + 2 * i), 1e-13);
        }
        EXPECT_EQ(w.state.totals.steps_not_converged, 0U);
    }
}

// Started exactly at rest and solved to 1e-6, with the correction of positions as it is by default: after the first
// step, which must find the impulses, the warm start has them.
TEST(Stack, AHundredStaysForTenSeconds) {
    World w(1e-2);
    w.scene.solver.tolerance = 1e-6;
    w.scene.solver.max_sweeps = 100000;
    w.scene.correction.on = true;
    for (int i = 0; i < 100; ++i) w.add(Vec3(0, 0, kRadius * (1 + 2 * i)), kRadius);
    w.add_floor();
    w.step();
    const std::uint64_t first = w.state.totals.sweeps;
    w.run(999);
    EXPECT_NEAR(w.position(99).z(), 199 * kRadius, 1e-3 * 2 * kRadius);
    // a residual of 1e-6 g h a contact, added over 100 contacts
    EXPECT_LT(w.fastest(), 100 * 1e-6 * kGravity * 1e-2);
    EXPECT_EQ(w.state.totals.steps_not_converged, 0U);
    EXPECT_LT(w.state.totals.sweeps - first, 20 * 999U);
    EXPECT_LE(w.energy(), w.state.ledger.potential_0 * (1 + 1e-9));
}

// A sphere in a groove whose sides rise by beta: each carries m g / (2 cos beta).
TEST(Groove, EachSideCarriesItsShare) {
    for (const double degrees : {10.0, 45.0, 80.0}) {
        const double beta = degrees * std::numbers::pi / 180.0;
        World w(1e-3);
        w.add(Vec3(0, 0, kRadius / std::cos(beta)), kRadius);
        for (const double side : {-1.0, 1.0})
            w.add_wall(PlaneWall{Vec3::Zero(), Vec3(side * std::sin(beta), 0, std::cos(beta))});
        w.run(20);
        const double share = w.mass() * kGravity * 1e-3 / (2.0 * std::cos(beta));
        for (const solvers::WallLoad& load : w.stepper->wall_loads())
            EXPECT_NEAR(load.impulse.norm() / share, 1.0, 1e-10);
        EXPECT_LT(w.fastest(), 1e-12);
    }
}

// With friction the share of each side is not unique; the sum is.
TEST(Groove, WithFrictionTheSumIsTheWeight) {
    World w(1e-3, 2.0);
    const double beta = 1.2;
    w.add(Vec3(0, 0, kRadius / std::cos(beta)), kRadius);
    for (const double side : {-1.0, 1.0})
        w.add_wall(PlaneWall{Vec3::Zero(), Vec3(side * std::sin(beta), 0, std::cos(beta))});
    w.run(20);
    Vec3 sum = Vec3::Zero();
    for (const solvers::WallLoad& load : w.stepper->wall_loads()) sum += load.impulse;
    EXPECT_LT((sum / (w.mass() * kGravity * 1e-3) + Vec3::UnitZ()).norm(), 1e-10);
    EXPECT_LT(w.fastest(), 1e-11);
}

// Four balls as a pyramid. The lines of centres from the top lean by asin(1 / sqrt 3) = 35.3 deg from the vertical;
// a ball below is held against turning at both its contacts, which takes mu >= tan(35.3 / 2 deg) = 0.32. With 0.5 it
// stands, without friction it falls flat.
TEST(Pyramid, StandsWithFrictionAndFallsWithout) {
    for (const double mu : {0.0, 0.5}) {
        World w(1e-3, mu);
        const double side = 2 * kRadius, out = side / std::sqrt(3.0);
        for (int k = 0; k < 3; ++k) {
            const double angle = 2.0 * std::numbers::pi / 3.0 * k;
            w.add(Vec3(out * std::cos(angle), out * std::sin(angle), kRadius), kRadius);
        }
        w.add(Vec3(0, 0, kRadius + side * std::sqrt(2.0 / 3.0)), kRadius);
        w.add_floor();
        const double top = w.position(3).z();
        w.run(1000);
        if (mu > 0.0) {
            EXPECT_NEAR(w.position(3).z(), top, 1e-6);
            EXPECT_LT(w.fastest(), 1e-9);
        } else {
            EXPECT_NEAR(w.position(3).z(), kRadius, 0.01);
        }
        EXPECT_LT(w.state.ledger.drift(), 1e-10);
    }
}

}  // namespace
}  // namespace scree
