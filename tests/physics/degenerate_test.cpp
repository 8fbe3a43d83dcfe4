// Bodies in positions in which geometry has no single answer, and scenes that have no solution: bounded and told.
#include <gtest/gtest.h>

#include <algorithm>
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

constexpr double kSide = 0.1, kStep = 1e-3;

Quat about(const Vec3& axis, double angle) {
    return Quat(Eigen::AngleAxisd(angle, axis.normalized()));
}
// Energy never above that of the start (e = 0), and finite.
void expect_no_gain(World& w, int steps) {
    if (!w.stepper) w.start();
    const double start = w.state.ledger.kinetic_0 + w.state.ledger.potential_0;
    const double scale = w.mass() * kGravity * kSide + std::abs(start);
    for (int k = 0; k < steps; ++k) {
        w.step();
        ASSERT_LE(w.energy(), start + 1e-9 * scale + w.state.ledger[Work::correction]) << k;
    }
    for (const Vec3& x : w.state.bodies.position) ASSERT_TRUE(x.allFinite());
}

// A cube on a cube, tilted: it settles onto the face. From 1e-3 it falls by 1e-4 m; whatever the tilt, it ends level
// and at the same place, and the force between them never exceeds what stops it from that fall.
TEST(Degenerate, NearlyParallelFaces) {
    for (const double tilt : {0.0, 1e-12, 1e-9, 1e-6, 1e-3}) {
        SCOPED_TRACE(tilt);
        World w(kStep, 0.5);
        w.standard_settings();
        w.add(cube(kSide), Vec3(0, 0, 0.5 * kSide));
        const Quat turn = about(Vec3(0.3, 1, 0), tilt);
        double low = 0.0;
        for (const Vec3& v : cube(kSide).vertex) low = std::min(low, (turn * v).z());
        w.add(cube(kSide), Vec3(0, 0, kSide - low), turn);
        w.add_floor();
        expect_no_gain(w, 1000);
        EXPECT_LT(w.fastest(), 1e-6);
        // each of the two contacts keeps an overlap of up to 5e-5 diameters
        const double kept = 2.0 * 5e-5 * 2.0 * w.radius();
        EXPECT_NEAR(w.position(1).z(), 1.5 * kSide, kept);
        EXPECT_LT(w.position(1).head<2>().norm(), kept + tilt * kSide);
        EXPECT_EQ(w.report.contacts, 8U);
    }
}

// A bar that stands on its edge, and another one that falls on it edge on edge, by 1 cm: crossed, where the normal is
// the product of the edges, and parallel or nearly so, where that has no length.
TEST(Degenerate, CrossedEdges) {
    const double upright = std::numbers::pi / 4.0;
    for (const double cross : {90.0, 45.0, 1.0, 1e-7, 0.0}) {
        SCOPED_TRACE(cross);
        World w(kStep, 0.5);
        w.standard_settings();
        const Polyhedron bar = box(Vec3(1.0, kSide, kSide));
        const Quat on_edge = about(Vec3::UnitX(), upright);
        const double up = kSide * std::sqrt(0.5);
        w.add(bar, Vec3(0, 0, up), on_edge);
        w.add(bar, Vec3(0, 0, 3 * up + 0.01), about(Vec3::UnitZ(), cross * std::numbers::pi / 180.0) * on_edge);
        w.add_floor();
        expect_no_gain(w, 7000);
        EXPECT_LT(w.fastest(), 1e-6);  // beside or across each other
        EXPECT_LT(w.state.totals.penetration_max_relative, 0.01);
    }
}

// A needle 100 : 1 : 1 and a plate 100 : 100 : 1 are dropped with a spin and roll to rest: nothing blows up, they lie.
TEST(Degenerate, NeedleAndPlateComeToRest) {
    for (const Vec3& sides : {Vec3(1.0, 0.01, 0.01), Vec3(1.0, 1.0, 0.01)}) {
        SCOPED_TRACE(sides.y());
        World w(kStep, 0.4);
        w.standard_settings();
        w.add(box(sides), Vec3(0, 0, 1.0), about(Vec3(1, 2, 0.5), 0.7), Vec3(1, 0, 0), Vec3(20, 5, 10));
        w.add_floor();
        expect_no_gain(w, 10000);
        EXPECT_LT(w.fastest(), 1e-4);
        EXPECT_NEAR(w.position().z(), 0.005, 1e-3);
        EXPECT_LT(w.state.ledger.drift(), 1e-8);
    }
}

// Two cubes in one place come apart: their overlap is taken away by displacements, so that no speed comes of it but
// that of the fall.
TEST(Degenerate, CoincidentBodiesSeparate) {
    for (const double beside : {0.0, 1e-12, 0.5}) {
        SCOPED_TRACE(beside);
        World w(kStep, 0.5);
        w.standard_settings();
        w.gravity(Vec3::Zero());
        w.add(cube(kSide), Vec3::Zero());
        w.add(cube(kSide), Vec3(beside * kSide, 0, 0));
        w.run(200);
        EXPECT_GT((w.position(1) - w.position(0)).norm(), 0.99 * kSide);
        EXPECT_LT(w.fastest(), 1e-12);
    }
}

// A cube between two walls at its exact width, under gravity and with friction: any pair of forces holds it, none is
// needed to keep it from passing. Forces stay bounded and it does not fall faster than free.
TEST(Degenerate, JamBetweenWalls) {
    World w(kStep, 0.5);
    w.standard_settings();
    w.add(cube(kSide), Vec3(0, 0, 1.0));
    for (const double side : {-1.0, 1.0}) w.add_wall(PlaneWall{Vec3(side * 0.5 * kSide, 0, 0), Vec3(-side, 0, 0)});
    w.start();
    const double step_of_weight = w.mass() * kGravity * kStep;
    for (int k = 0; k < 1000; ++k) {
        w.step();
        for (const solvers::WallLoad& load : w.stepper->wall_loads())
            ASSERT_LT(load.impulse.norm(), 100.0 * step_of_weight) << k;
    }
    EXPECT_LE(w.energy(), w.state.ledger.potential_0 * (1 + 1e-9));
    EXPECT_LT(std::abs(w.velocity().x()), 1e-6);
    EXPECT_LT(w.spin().norm(), 1e-4);
}

// Two walls close on a cube. As long as it fits nothing is wrong; then no velocity satisfies both walls and the floor,
// but at moments at which a cube that has been turned can still turn on. Steps that are not solved are counted, the
// penetration that is reported is at least what geometry asks for, velocities and impulses stay bounded.
TEST(Degenerate, WallsThatCloseOnACubeAreReported) {
    World w(kStep, 0.5);
    w.standard_settings();
    w.add(cube(kSide), Vec3(0, 0, 0.5 * kSide));
    w.add_floor();
    const double speed = 0.1;
    for (const double side : {-1.0, 1.0}) {
        WallMotion close;
        close.velocity = Vec3(-side * speed, 0, 0);
        w.add_wall(PlaneWall{Vec3(side * 0.51 * kSide, 0, 0), Vec3(-side, 0, 0)}, close);
    }
    w.run(10);
    EXPECT_EQ(w.state.totals.steps_not_converged, 0U);
    for (int k = 0; k < 100; ++k) {
        w.step();
        // a cube is nowhere narrower than its side: half of what is missing at one of the walls, at least, but for the
        // linear terms of a turn by 0.05 and what the two centres differ
        const double missing = 0.5 * (kSide - (1.02 * kSide - 2.0 * speed * w.state.time));
        EXPECT_GT(w.report.penetration.max, 0.5 * missing - 1e-4) << k;
        EXPECT_LT(w.fastest(), 2.0 * speed);
        for (const solvers::WallLoad& load : w.stepper->wall_loads())
            // a sweep adds the momentum of the cube at the speed of the walls, at most from 110 steps on end
            EXPECT_LT(load.impulse.norm(), 110.0 * w.scene.solver.max_sweeps * 2.0 * w.mass() * speed);
    }
    EXPECT_GT(w.state.totals.steps_not_converged, 10U);
}

}  // namespace
}  // namespace scree
