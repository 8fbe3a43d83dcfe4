// Stiff and extreme cases. All of them: no NaN, no crash, no energy from nowhere, momentum to round-off, and a step
// that did not reach its tolerance says so.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "tests/testing/closed_forms.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::kGravity;
using testing::World;

constexpr double kRadius = 0.1;

// What every case must keep, after each step. Energy may come from walls that move, from bodies that are pushed out of
// each other and from contacts that the ledger names.
void expect_sane(World& w) {
    const Ledger& l = w.state.ledger;
    ASSERT_TRUE(std::isfinite(w.energy()));
    ASSERT_LT(l.drift(), 1e-10);
    ASSERT_LE(w.report.momentum_error, 1e-12);
    const double given = l[Work::correction] + l[Work::walls] + l[Work::gravity] + l.gained;
    const double scale = std::max(l.kinetic_max, l.potential_max - l.potential_min);
    ASSERT_LE(w.energy(),
              l.kinetic_0 + l.potential_0 + std::max(given, 0.0) + 1e-9 * scale + 1e-13 * std::abs(l.potential_0));
    const bool reached = w.report.residual_rms <= w.scene.solver.tolerance;
    ASSERT_TRUE(reached || !w.report.converged) << "silent: " << w.report.residual_rms;
}
void run(World& w, int steps) {
    for (int k = 0; k < steps; ++k) {
        w.step();
        expect_sane(w);
        if (::testing::Test::HasFatalFailure()) return;
    }
}

// A ball of 1 kg under one of `ratio` kg. Gauss-Seidel's factor a sweep is ratio / (1 + ratio): with few sweeps the
// step must say that it has not converged; with enough of them the forces are g and (1 + ratio) g.
class HeavyOnLight : public ::testing::TestWithParam<double> {};
TEST_P(HeavyOnLight, ConvergesOrSaysThatItDoesNot) {
    const double ratio = GetParam();
    for (const int most : {10, 100000}) {
        World w(1e-3);
        w.scene.solver.max_sweeps = most;
        w.scene.solver.tolerance = 1e-4;
        w.scene.solver.method = SolverMethod::gauss_seidel;
        w.scene.solver.warm_start = false;
        w.add(Vec3(0, 0, kRadius), kRadius, Vec3::Zero(), Vec3::Zero(), 1.0);
        w.add(Vec3(0, 0, 3 * kRadius), kRadius, Vec3::Zero(), Vec3::Zero(), ratio);
        w.add_floor();
        const int steps = ratio > 1e3 ? 2 : 10;
        run(w, steps);
        if (most == 10 && ratio > 1.0) {
            EXPECT_EQ(w.state.totals.steps_not_converged, static_cast<std::uint64_t>(steps));
        }
        if (most == 10) continue;
        EXPECT_EQ(w.state.totals.steps_not_converged, 0U);
        // residual 1e-4 g h at the contacts; each sweep closes 1 / (1 + ratio) of what is left, of (1 + ratio) g h
        const double floor = w.stepper->wall_loads()[0].impulse.norm() / (w.stepper->last_step() * kGravity);
        EXPECT_NEAR(floor / (1.0 + ratio), 1.0, 2e-4);
    }
}
INSTANTIATE_TEST_SUITE_P(Ratios, HeavyOnLight, ::testing::Values(10.0, 1e3, 1e4));

TEST(LightOnHeavy, NeedsAFewSweeps) {
    World w(1e-3);
    w.scene.solver.tolerance = 1e-4;
    w.add(Vec3(0, 0, kRadius), kRadius, Vec3::Zero(), Vec3::Zero(), 1.0);
    w.add(Vec3(0, 0, 3 * kRadius), kRadius, Vec3::Zero(), Vec3::Zero(), 1e-6);
    w.add_floor();
    w.step();
    EXPECT_TRUE(w.report.converged);
    EXPECT_LE(w.report.sweeps, 4);
}

// 1 cm balls at 10 to 1000 m/s against thin walls, with steps of up to a hundred diameters: the step is cut, and
// nothing passes.
class FastImpact : public ::testing::TestWithParam<double> {};
TEST_P(FastImpact, NothingPassesThroughAThinWall) {
    const double speed = GetParam();
    Random random(8, 1, 0);
    std::uint64_t substepped = 0;
    for (int phase = 0; phase < 12; ++phase)
        for (const double e : {0.0, 0.5}) {
            World w(1e-3, 0.3, e);
            const double start = 0.1 + speed * 1e-3 * random.uniform();
            w.add(Vec3(0.01, 0, start), 0.005, Vec3(0.1 * speed, 0, -speed));
            w.add_wall(DiscWall{Vec3::Zero(), Vec3::UnitZ(), 1e3});
            const int steps = static_cast<int>(2.0 * start / (speed * 1e-3)) + 3;
            run(w, steps);
            EXPECT_GT(w.position().z(), 0.0) << "passed at " << speed << " m/s";
            EXPECT_GT(w.velocity().z(), -0.1);
            substepped += w.state.totals.substepped;
        }
    EXPECT_GT(substepped, 0U);
}
TEST_P(FastImpact, NothingPassesThroughABall) {
    const double speed = GetParam();
    for (int phase = 0; phase < 8; ++phase) {
        World w(1e-3, 0.3, 0.5);
        w.gravity(Vec3::Zero());
        w.add(Vec3::Zero(), 0.005);
        w.add(Vec3(-0.02 - speed * 1e-3 * phase / 8.0, 0.001, 0), 0.005, Vec3(speed, 0, 0));
        run(w, 25 + static_cast<int>(40.0 / speed));
        EXPECT_GT(w.velocity(0).x(), 0.5 * speed) << "passed at " << speed << " m/s";
        EXPECT_GT(w.position(0).x(), w.position(1).x());
    }
}
INSTANTIATE_TEST_SUITE_P(Speeds, FastImpact, ::testing::Values(10.0, 100.0, 1000.0));

// The wall comes instead of the ball.
TEST(FastWall, AThinWallSweepsAlongWhatItMeets) {
    for (const double speed : {5.0, 50.0, 500.0}) {
        World w(1e-3);
        w.gravity(Vec3::Zero());
        w.add(Vec3(0, 0, 0.1 + speed * 3.3e-3), 0.005);
        WallMotion come;
        come.velocity = Vec3(0, 0, speed);
        w.add_wall(DiscWall{Vec3::Zero(), Vec3::UnitZ(), 1.0}, come);
        run(w, 6 + static_cast<int>(100.0 / speed));
        EXPECT_NEAR(w.velocity().z(), speed, 1e-9 * speed) << "the wall passed through at " << speed << " m/s";
    }
}

class Overlap : public ::testing::TestWithParam<double> {};  // distance of the centres in radii
TEST_P(Overlap, SeparatesWithoutGainingSpeed) {
    for (const double mu : {0.0, 0.5}) {
        World w(1e-3, mu, 0.5);
        w.gravity(Vec3::Zero());
        w.scene.correction.on = true;
        w.add(Vec3(0.3, 0.2, 0.1), kRadius);
        w.add(Vec3(0.3 + GetParam() * kRadius, 0.2, 0.1), kRadius);
        double depth = 1e300;
        for (int k = 0; k < 100; ++k) {
            w.step();
            expect_sane(w);
            EXPECT_LT(w.fastest(), 1e-12);  // positions are corrected, velocities are not
            // positions of 0.3 are rounded to 5.6e-17, the distance of two to twice that
            EXPECT_LE(w.report.penetration.max, depth * (1.0 + 1e-12) + 1.2e-16);
            depth = w.report.penetration.max;
        }
        EXPECT_GT((w.position(0) - w.position(1)).norm(), 2.0 * kRadius * (1.0 - 1e-9));
        EXPECT_LT(
            (w.position(0) + w.position(1)).norm() - 2.0 * Vec3(0.3 + 0.5 * GetParam() * kRadius, 0.2, 0.1).norm(),
            1e-12);  // about the centre of mass
    }
}
INSTANTIATE_TEST_SUITE_P(Distances, Overlap, ::testing::Values(0.0, 1e-12, 0.1, 1.0, 1.9));

TEST(Overlaps, AHeapThatStartsHalfInsideItself) {
    World w(1e-3, 0.3);
    w.scene.correction.on = true;
    w.scene.solver = SolverSettings{};
    Random random(3, 1, 0);
    for (int i = 0; i < 64; ++i)
        w.add(Vec3(0.1 * (i % 4), 0.1 * (i / 4 % 4), 0.1 + 0.1 * (i / 16)) +
                  1e-3 * Vec3(random.normal(), random.normal(), 0),
              0.09);
    w.add_wall(BoxWall{Vec3(-1, -1, 0), Vec3(2, 2, 3), true, false, false});
    const double top = 0.6;
    run(w, 400);
    // no more speed than a fall from the height that the correction may lift to
    EXPECT_LT(w.fastest(), std::sqrt(2.0 * kGravity * 2.0 * top));
    EXPECT_LT(w.report.penetration.max_relative, 0.02);
}

// mu = 0: no tangential impulse at all. mu = 1e3: sticks on a slope of 80 degrees, to which friction of 5.7 is enough.
TEST(Friction, ZeroIsExactlyZero) {
    World w(1e-3, 0.0, 0.5);
    w.scene.output.contacts = true;
    for (int i = 0; i < 6; ++i) w.add(Vec3(0.15 * i, 0.02 * i, 0.3), kRadius, Vec3(1, 0, -1));
    w.add_floor();
    for (int k = 0; k < 200; ++k) {
        w.step();
        for (const ContactRecord& c : w.stepper->contacts())
            ASSERT_LE((c.impulse - c.impulse.dot(c.normal) * c.normal).norm(), 1e-15 * c.impulse.norm());
    }
    EXPECT_FALSE(w.state.bodies.has_spin());
}
TEST(Friction, HugeCoefficientsRollDownAnySlope) {
    for (const double mu : {2.0, 10.0, 1e3, 1e6}) {
        World w(1e-3, mu);
        w.scene.solver.tolerance = 1e-13 * (1.0 + mu);  // the natural map has mu |u_T| in it, and so its round-off
        const double angle = 80.0 * std::numbers::pi / 180.0;
        w.gravity(kGravity * Vec3(std::sin(angle), 0, -std::cos(angle)));
        w.add(Vec3(0, 0, kRadius), kRadius);
        w.add_floor();
        run(w, 500);
        const double a = 5.0 / 7.0 * kGravity * std::sin(angle) * 0.5;
        EXPECT_NEAR(w.velocity().x() / a, 1.0, 1e-10);
        EXPECT_EQ(w.state.totals.steps_not_converged, 0U);
    }
}

// e = 0 and e = 1 in one step: two equal balls fall on two floors at once, symmetric about the middle.
TEST(Restitution, PlasticAndElasticContactsInOneStep) {
    World w(1e-3);
    w.scene.materials.push_back({"rubber", 2500.0});
    w.scene.pairs = PairTable(2);
    w.scene.pairs.set(MaterialIndex{0}, MaterialIndex{1}, {0.2, 1.0});
    w.scene.pairs.set(MaterialIndex{0}, MaterialIndex{0}, {0.2, 0.0});
    w.gravity(Vec3::Zero());
    for (const double side : {-1.0, 1.0}) w.add(Vec3(side * kRadius, 0, kRadius), kRadius, Vec3(0, 0, -1));
    w.add(Vec3(0, 0, kRadius + std::sqrt(3.0) * kRadius), kRadius, Vec3(0, 0, -2));  // on both, in the middle
    w.add_floor();
    w.scene.walls[0].material = MaterialIndex{1};
    run(w, 1);
    EXPECT_NEAR(w.velocity(0).x(), -w.velocity(1).x(), 1e-11);
    EXPECT_NEAR(w.velocity(0).z(), w.velocity(1).z(), 1e-11);
    EXPECT_NEAR(w.velocity(2).x(), 0.0, 1e-11);
    EXPECT_NEAR(w.spin(0).y(), -w.spin(1).y(), 1e-9);
}

// A wall closes on a ball that lies on another wall: no motion is possible. Impulses stay bounded, the step says so.
TEST(Infeasible, TwoWallsThatCloseOnABall) {
    World w(1e-3);
    w.scene.solver.max_sweeps = 200;
    w.add(Vec3(0, 0, kRadius), kRadius);
    WallMotion down;
    down.velocity = Vec3(0, 0, -0.5);
    w.add_floor();
    w.add_wall(PlaneWall{Vec3(0, 0, 2 * kRadius + 1e-3), -Vec3::UnitZ()}, down);
    for (int k = 0; k < 20; ++k) {
        w.step();
        ASSERT_TRUE(std::isfinite(w.energy()));
    }
    EXPECT_GT(w.state.totals.steps_not_converged, 10U);
    EXPECT_LT(w.fastest(), 1.0);
    EXPECT_LT(w.report.penetration.max, 0.5 * 20e-3);  // what the walls prescribe, shared, and no more
}

// A dense scene moved by a map's coordinates: positions lose digits (ulp(5.6e6) = 9.3e-10 m), nothing else. Few steps,
// so that chaos does not blow it up: nine digits are left of 0.1 m, and some are amplified by the impacts.
TEST(Offset, FarFromTheOriginIsTheSameToTheDigitsLeft) {
    const auto run_at = [](const Vec3& origin) {
        auto w = std::make_unique<World>(1e-3, 0.3, 0.2);
        for (int i = 0; i < 27; ++i)
            w->add(origin + Vec3(0.211 * (i % 3), 0.213 * (i / 3 % 3), 0.1117 + 0.217 * (i / 9)), 0.1,
                   Vec3(0.3 * (i % 2), 0, 0));
        w->add_wall(PlaneWall{origin, Vec3::UnitZ()});
        w->scene.correction.on = true;
        w->run(150);
        std::vector<Vec3> x;
        for (const Vec3& p : w->state.bodies.position) x.push_back(p - origin);
        return x;
    };
    const auto near = run_at(Vec3::Zero()), far = run_at(Vec3(538500, 5576504, 2000));
    for (std::size_t i = 0; i < near.size(); ++i) EXPECT_LT((near[i] - far[i]).norm(), 1e-6);
}

// One ball with a thousand of a hundredth of its size around it: the fine ones neither get into it nor through it.
TEST(SizeRatio, OneToAHundred) {
    World w(2e-4, 0.3);
    w.scene.solver = SolverSettings{};
    w.scene.correction.on = true;
    w.add(Vec3(0, 0, 1.0), 1.0);
    Random random(5, 1, 0);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 n = Vec3(random.normal(), random.normal(), std::abs(random.normal())).normalized();
        w.add(Vec3(0, 0, 1.0) + (1.012 + 0.2 * random.uniform()) * n, 0.01, -2.0 * n);
    }
    w.add_floor();
    run(w, 300);
    for (std::size_t i = 1; i < w.state.bodies.size(); ++i)
        ASSERT_GT((w.position(i) - w.position(0)).norm(), 1.0) << "inside the large ball";
}

// Steps from far too small to far too large on the same drop: bounded energy, bounded penetration.
TEST(StepSize, AnyStepIsStable) {
    for (const double h : {1e-6, 1e-4, 1e-2, 1e-1}) {
        World w(h, 0.4, 0.3);
        w.scene.solver = SolverSettings{};
        w.scene.correction.on = true;
        for (int i = 0; i < 20; ++i) w.add(Vec3(0.12 * (i % 3), 0.13 * (i % 2), 0.12 + 0.21 * (i / 3)), kRadius);
        w.add_wall(BoxWall{Vec3(-0.2, -0.2, 0), Vec3(0.5, 0.5, 5), true, false, false});
        run(w, h < 1e-5 ? 2000 : 300);
        for (const Vec3& x : w.state.bodies.position) ASSERT_LT(x.norm(), 5.0) << "h " << h;
    }
}

}  // namespace
}  // namespace scree
