// Single impacts and chains of balls, against the hard-sphere law.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/testing/closed_forms.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::cradle_speed;
using testing::oblique_impact;
using testing::World;

constexpr double kRadius = 0.1, kRestitution = 0.8, kFriction = 0.1;

// The table of validation: angle from the normal, v_n', v_t', R omega', E'/E for e = 0.8, mu = 0.1, |v| = 1.
struct ObliqueRow {
    double degrees, normal, tangential, surface, energy;
};
class ObliqueImpact : public ::testing::TestWithParam<ObliqueRow> {};

TEST_P(ObliqueImpact, OnAWall) {
    const ObliqueRow& row = GetParam();
    const double angle = row.degrees * std::numbers::pi / 180.0;
    World w(1e-3, kFriction, kRestitution);
    w.gravity(Vec3::Zero());
    w.add(Vec3(0, 0, kRadius), kRadius, Vec3(std::sin(angle), 0, -std::cos(angle)));
    w.add_floor();
    w.run(3);
    EXPECT_NEAR(w.velocity().z(), row.normal, 1e-6);  // the table's digits
    EXPECT_NEAR(w.velocity().x(), row.tangential, 1e-6);
    EXPECT_NEAR(w.spin().y() * kRadius, row.surface, 1e-6);
    EXPECT_NEAR(2.0 * w.state.ledger.kinetic / w.mass(), row.energy, 1e-6);
    const auto exact = oblique_impact(std::cos(angle), std::sin(angle), kRestitution, kFriction);
    EXPECT_NEAR(w.velocity().z(), exact.normal, 1e-12);
    EXPECT_NEAR(w.velocity().x(), exact.tangential, 1e-12);
    EXPECT_NEAR(w.spin().y() * kRadius, exact.surface, 1e-12);
    EXPECT_LT(w.state.ledger.drift(), 1e-12);
    EXPECT_LT(w.state.totals.momentum_error_max, 1e-12);
    EXPECT_EQ(w.state.ledger.gained, 0.0);
}

// Two equal spheres, one at rest: the same with relative velocities, shared equally.
TEST_P(ObliqueImpact, OfTwoEqualSpheres) {
    const ObliqueRow& row = GetParam();
    const double angle = row.degrees * std::numbers::pi / 180.0;
    World w(1e-4, kFriction, kRestitution);
    w.gravity(Vec3::Zero());
    // the middle of the step, where the contact is found, has the centres exactly above each other
    const Vec3 v(std::sin(angle), 0, -std::cos(angle));
    w.add(Vec3::Zero(), kRadius);
    w.add(Vec3(0, 0, 2 * kRadius) - 0.5e-4 * v, kRadius, v);
    w.step();
    const auto exact = oblique_impact(std::cos(angle), std::sin(angle), kRestitution, kFriction);
    const Vec3 relative = w.velocity(1) - w.velocity(0);
    EXPECT_NEAR(relative.z(), exact.normal, 1e-11);
    EXPECT_NEAR(relative.x(), exact.tangential, 1e-11);
    // each takes half of the tangential impulse, and the surface speed of both together is that of the wall's case
    EXPECT_NEAR((w.spin(0) + w.spin(1)).y() * kRadius, exact.surface, 1e-11);
    EXPECT_NEAR(w.spin(0).y(), w.spin(1).y(), 1e-10);
    EXPECT_LT((w.momentum() - w.mass() * v).norm(), 1e-14 * w.mass());
    EXPECT_LT(w.state.ledger.drift(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Table, ObliqueImpact,
                         ::testing::Values(ObliqueRow{15, 0.772741, 0.184871, 0.184871, 0.644976},
                                           ObliqueRow{30, 0.692820, 0.357143, 0.357143, 0.658571},
                                           ObliqueRow{45, 0.565685, 0.579828, 0.318198, 0.696700},
                                           ObliqueRow{60, 0.400000, 0.776025, 0.225000, 0.782465},
                                           ObliqueRow{75, 0.207055, 0.919338, 0.116469, 0.893481}));

// m1 and m2 head on: the textbook's result with the reduced mass.
TEST(HeadOn, UnequalMasses) {
    for (const double ratio : {1.0, 3.0, 1e3, 1e6})
        for (const double e : {0.0, 0.5, 1.0}) {
            World w(1e-3, 0.0, e);
            w.gravity(Vec3::Zero());
            w.add(Vec3(0, 0, 0), kRadius, Vec3(1, 0, 0), Vec3::Zero(), ratio);
            w.add(Vec3(2 * kRadius, 0, 0), kRadius, Vec3(-2, 0, 0), Vec3::Zero(), 1.0);
            w.step();
            const double centre = (ratio - 2.0) / (ratio + 1.0);
            EXPECT_NEAR(w.velocity(0).x(), centre - 3.0 * e / (ratio + 1.0), 1e-12);
            EXPECT_NEAR(w.velocity(1).x(), centre + 3.0 * e * ratio / (ratio + 1.0), 1e-12);
        }
}

struct CradleCase {
    int balls, incoming;
};
class NewtonsCradle : public ::testing::TestWithParam<CradleCase> {};

// Touching balls with one Newton law a contact, solved together. Not the toy's answer; it is the law's.
TEST_P(NewtonsCradle, TouchingBallsAreSolvedTogether) {
    const auto [n, incoming] = GetParam();
    for (const double e : {0.0, 0.5, 1.0}) {
        World w(1e-3, 0.0, e);
        w.gravity(Vec3::Zero());
        for (int i = 0; i < n; ++i) w.add(Vec3(2 * kRadius * i, 0, 0), kRadius, Vec3(i < incoming ? 1 : 0, 0, 0));
        w.step();
        ASSERT_TRUE(w.report.converged);
        for (int i = 0; i < n; ++i)
            EXPECT_NEAR(w.velocity(static_cast<std::size_t>(i)).x(), cradle_speed(n, incoming, e, i), 1e-11);
        EXPECT_NEAR(w.momentum().x() / w.mass(), incoming, 1e-13);
        if (e == 1.0) {
            EXPECT_NEAR(2.0 * w.state.ledger.kinetic / w.mass(), incoming, 1e-11);
        }
        EXPECT_LT(w.state.ledger.drift(), 1e-12);
    }
}
INSTANTIATE_TEST_SUITE_P(Table, NewtonsCradle,
                         ::testing::Values(CradleCase{2, 1}, CradleCase{3, 1}, CradleCase{4, 1}, CradleCase{5, 1},
                                           CradleCase{5, 2}));

// With gaps wider than a step's motion each collision is for itself: the toy's answer, exactly.
TEST(NewtonsCradleWithGaps, OneGoesInOneComesOut) {
    for (const int incoming : {1, 2}) {
        World w(1e-3, 0.0, 1.0);
        w.gravity(Vec3::Zero());
        const double gap = 4.3e-3;  // > v h = 1e-3
        for (int i = 0; i < 5; ++i)
            w.add(Vec3((2 * kRadius + gap) * i, 0, 0), kRadius, Vec3(i < incoming ? 1 : 0, 0, 0));
        w.run(60);
        for (int i = 0; i < 5; ++i)
            EXPECT_NEAR(w.velocity(static_cast<std::size_t>(i)).x(), i >= 5 - incoming ? 1.0 : 0.0, 1e-12);
        EXPECT_NEAR(2.0 * w.state.ledger.kinetic / w.mass(), incoming, 1e-12);
    }
}

}  // namespace
}  // namespace scree
