// The correction of positions: how far, whom, and what it leaves alone.
#include "solvers/position_correction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "tests/testing/solver_case.hpp"

namespace scree::solvers {
namespace {

using testing::SmallScene;
using testing::SolverCase;

// Corrects the bodies where they stand.
CorrectionReport correct(SmallScene& w, bool on, int sweeps, double share, std::size_t closed = 0,
                         SolverPrecision precision = SolverPrecision::full) {
    w.scene.correction = {on, sweeps, share};
    w.scene.solver.precision = precision;
    contact::CandidateList candidates;
    PositionCorrection correction;
    Domain domain;
    w.state.block_size = choose_block_size(w.state.bodies);
    return correction.apply(w.scene, w.scene.time.step, closed, candidates, domain, w.state);
}

TEST(PositionCorrection, SharesTheOverlapByInverseMass) {
    SmallScene w(1e-3);
    w.add(Vec3(0, 0, 0), 0.1, Vec3::Zero(), Vec3::Zero(), 1.0);
    w.add(Vec3(0.1996, 0, 0), 0.1, Vec3::Zero(), Vec3::Zero(), 3.0);
    const CorrectionReport r = correct(w, true, 5, 0.5);
    // half of 0.4 mm, three quarters of it by the lighter one
    EXPECT_NEAR(w.position(0).x(), -1.5e-4, 1e-16);
    EXPECT_NEAR(w.position(1).x(), 0.19965, 1e-16);
    EXPECT_NEAR(r.penetration.max, 2e-4, 1e-16);
    EXPECT_NEAR(r.penetration.mean, 2e-4, 1e-12);                             // added in units of 2^-40 of a block
    EXPECT_NEAR(correct(w, false, 5, 0.5, 4).penetration.mean, 5e-5, 1e-12);  // over four closed contacts
    EXPECT_NEAR(r.penetration.max_relative, 1e-3, 1e-15);
}

// Displacements are rounded to single precision, gaps are not: what differs is 1e-7 of how far bodies are moved.
TEST(PositionCorrection, SinglePrecisionMovesBodiesAsFar) {
    const auto pile = [] {
        SmallScene w(1e-3);
        w.add_floor();
        Random random(3, 0, 0);
        for (int x = 0; x < 6; ++x)
            for (int y = 0; y < 6; ++y)
                for (int z = 0; z < 6; ++z) {
                    const double r = random.uniform(0.09, 0.1);
                    w.add(Vec3(0.19 * x, 0.19 * y, 0.09 + 0.19 * z), r, Vec3::Zero(), Vec3::Zero(),
                          std::exp2(random.uniform(0.0, 12.0)));
                }
        return w;
    };
    SmallScene before = pile(), full = pile(), single = pile();
    const CorrectionReport a = correct(full, true, 40, 0.8);
    const CorrectionReport b = correct(single, true, 40, 0.8, 0, SolverPrecision::mixed);
    EXPECT_EQ(a.sweeps, b.sweeps);
    double farthest = 0.0, difference = 0.0;
    for (std::size_t i = 0; i < full.state.bodies.size(); ++i) {
        farthest = std::max(farthest, (full.position(i) - before.position(i)).norm());
        difference = std::max(difference, (full.position(i) - single.position(i)).norm());
    }
    EXPECT_GT(farthest, 1e-3);
    EXPECT_GT(difference, 0.0);
    EXPECT_LT(difference, 40 * 0x1p-24 * 16.0 * farthest);  // 40 sweeps of some sixteen roundings a body
    EXPECT_NEAR(a.penetration.max, b.penetration.max, 1e-4 * a.penetration.max);
}

TEST(PositionCorrection, OfDeepOverlapsLittleStays) {
    SmallScene w(1e-3);
    w.add(Vec3(0, 0, 0), 0.1);
    w.add(Vec3(0.18, 0, 0), 0.1);
    const CorrectionReport r = correct(w, true, 5, 0.5);
    EXPECT_NEAR(r.penetration.max_relative, 3e-3, 1e-15);
    EXPECT_NEAR(w.position(1).x() - w.position(0).x(), 0.2 * (1.0 - 3e-3), 1e-15);
}

TEST(PositionCorrection, LiftsFromAFloorAndSaysWhatItCost) {
    SmallScene w(1e-3);
    w.add(Vec3(0, 0, 0.096), 0.1, Vec3(0, 0, 0), Vec3::Zero(), 2.0);
    w.add_floor();
    const CorrectionReport r = correct(w, true, 3, 1.0);
    EXPECT_NEAR(w.position().z(), 0.1, 1e-16);
    EXPECT_NEAR(r.work, 2.0 * 9.81 * 0.004, 1e-15);
    EXPECT_LT(r.penetration.max, 1e-16);
}

TEST(PositionCorrection, OffOrWithoutOverlapNothingMoves) {
    SmallScene w(1e-3);
    w.add(Vec3(0, 0, 0.096), 0.1);
    w.add_floor();
    const CorrectionReport off = correct(w, false, 5, 0.5);
    EXPECT_EQ(w.position().z(), 0.096);
    EXPECT_NEAR(off.penetration.max, 0.004, 1e-16);  // measured all the same
    EXPECT_NEAR(off.penetration.max_relative, 0.02, 1e-15);
    w.position().z() = 0.1;
    EXPECT_EQ(correct(w, true, 5, 0.5).sweeps, 0);
    EXPECT_EQ(w.position().z(), 0.1);
}

// A row of balls that touch, the first two overlapping: nobody is pushed into its neighbour, and the centre of mass
// stays. Sweeps end when they move nobody by more than 1e-4 of a diameter.
TEST(PositionCorrection, DoesNotPushIntoNeighbours) {
    SmallScene w(1e-3);
    for (int i = 0; i < 5; ++i) w.add(Vec3(0.2 * i - (i > 0 ? 0.01 : 0.0), 0, 0), 0.1);
    correct(w, true, 1000, 1.0);
    for (std::size_t i = 0; i + 1 < 5; ++i) EXPECT_GT((w.position(i + 1) - w.position(i)).norm(), 0.2 - 1e-3) << i;
    EXPECT_LT(w.position(0).x(), -0.005);  // one against four
    Vec3 centre = Vec3::Zero();
    for (std::size_t i = 0; i < 5; ++i) centre += w.position(i) / 5;
    EXPECT_NEAR(centre.x(), 0.4 - 0.008, 1e-14);
}

TEST(PositionCorrection, WallsThatMoveAreWhereTheyAreAtTheEnd) {
    SmallScene w(0.1);
    w.add(Vec3(0, 0, 0.1), 0.1);
    WallMotion up;
    up.velocity = Vec3(0, 0, 0.3);
    w.add_wall(PlaneWall{Vec3::Zero(), Vec3::UnitZ()}, up);
    w.state.time = 0.0;
    correct(w, true, 3, 1.0);
    EXPECT_NEAR(w.position().z(), 0.13, 1e-15);
}

TEST(PositionCorrection, VelocitiesStayAsTheyAre) {
    SmallScene w(1e-3);
    Random random(2, 1, 0);
    for (int i = 0; i < 60; ++i)
        w.add(Vec3(random.uniform(), random.uniform(), 0.3 * random.uniform()), 0.1,
              Vec3(random.normal(), random.normal(), random.normal()));
    w.add_floor();
    const std::vector<Vec3> velocity = w.state.bodies.velocity;
    double deepest = 1e300;
    for (int k = 0; k < 30; ++k) {
        const double depth = correct(w, true, 40, 0.8).penetration.max;
        EXPECT_LE(depth, deepest + 1e-4 * 0.2);  // to what the sweeps leave
        deepest = depth;
    }
    EXPECT_LT(deepest, 0.2e-2);  // of overlaps of up to 0.2 at first: 1 % of the diameter
    EXPECT_EQ(w.state.bodies.velocity, velocity);
}

}  // namespace
}  // namespace scree::solvers
