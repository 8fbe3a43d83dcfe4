// Sweeps in single precision: when they are used, and that what comes out is the solution in double precision.
#include "solvers/single_problem.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "solvers/gauss_seidel.hpp"
#include "tests/testing/solver_case.hpp"

namespace scree::solvers {
namespace {

using testing::SmallScene;
using testing::SolverCase;

constexpr double kStep = 1e-3;

// A bed of `side` x `side` x 6 spheres that press on each other with random velocities, in several blocks of space; all
// lengths times 2^2k, times 2^k for time, so that velocities scale with 2^k and g does not.
void bed(SmallScene& w, int side, bool spin, int k = 0, double fastest = 0.02) {
    const double unit = std::ldexp(1.0, 2 * k), speed = std::ldexp(1.0, k);
    w.scene.time.step = std::ldexp(kStep, k);
    Random random(5, 1, 0);
    const auto vector = [&]() -> Vec3 { return fastest * Vec3(random.normal(), random.normal(), random.normal()); };
    for (int i = 0; i < 6 * side * side; ++i) {
        const Vec3 at(i % side, i / side % side, 0.5 + i / side / side);
        const double radius = unit * random.uniform(0.0101, 0.0104);
        w.add(unit * 0.02 * at, radius, speed * vector());
        if (spin) w.state.bodies.spin.push_back(speed / radius * vector());
    }
    w.add_floor();
}

SolverSettings settings(SolverPrecision precision, double tolerance = 1e-2) {
    SolverSettings s;
    s.precision = precision;
    s.tolerance = tolerance;
    s.max_sweeps = 2000;
    return s;
}
constexpr auto kMixed = SolverPrecision::mixed, kFull = SolverPrecision::full;

TEST(SingleProblem, UsedOnlyWhereItCannotBeWhatLimits) {
    const Extremes usual{1.0, 1e3, 1e-2, 0.5};
    EXPECT_TRUE(single_is_enough(settings(kMixed), usual, 0.1));
    EXPECT_FALSE(single_is_enough(settings(kFull), usual, 0.1));
    EXPECT_FALSE(single_is_enough(settings(kMixed, 9e-4), usual, 10.0));
    EXPECT_TRUE(single_is_enough(settings(kMixed, 1e-3), usual, 10.0));
    EXPECT_FALSE(single_is_enough(settings(kMixed), usual, 0.01));  // 1e-2 * 1e-2 < 1e3 * 1.2e-7 * 1.5
    EXPECT_FALSE(single_is_enough(settings(kMixed), {1.0, 1e3, 1e-2, 1e3}, 0.1));
    EXPECT_FALSE(single_is_enough(settings(kMixed), {1.0, 1e3, 1.1e3, 0.5}, 0.1));  // masses of 1 to 1.1e6
}

// One sweep from the same impulses does the same to round-off: no two contacts side by side share a body, and none is
// left out.
template <class Law>
void expect_the_same_sweep(bool spin) {
    SmallScene w(kStep, spin ? 0.4 : 0.0);
    bed(w, 24, spin);
    SolverCase<Law> in_double(w), mixed(w);
    ASSERT_GT(in_double.layout.phase(0).end, 3U);  // blocks of one colour, to lie side by side
    ASSERT_TRUE(mixed.problem.begin_single(settings(kMixed)));
    in_double.problem.reset_momentum();
    mixed.problem.reset_momentum();
    for (int k = 0; k < 3; ++k) {
        const double change = in_double.problem.sweep(0.3, true);
        EXPECT_NEAR(mixed.problem.sweep(0.3, true), change, 1e-5 * change);
    }
    const Residual expected = in_double.problem.residual(), got = mixed.problem.residual();
    EXPECT_GT(expected.rms, 1e-3);
    EXPECT_NEAR(got.rms, expected.rms, 1e-5 * expected.rms);
    EXPECT_NEAR(got.max, expected.max, 1e-4 * expected.max);
    mixed.problem.end_single();
    for (std::size_t i = 0; i < w.state.bodies.size(); ++i)
        EXPECT_LT((mixed.velocity(i) - in_double.velocity(i)).norm(), 1e-5 * in_double.problem.reference_velocity());
}
TEST(SingleProblem, ASweepIsThatInDoublePrecision) {
    expect_the_same_sweep<Frictional>(true);
    expect_the_same_sweep<Frictionless>(false);
}

template <class Law>
void expect_the_solution(bool spin) {
    SmallScene w(kStep, spin ? 0.4 : 0.0);
    bed(w, 12, spin);
    SolverCase<Law> exact(w);
    ASSERT_TRUE(gauss_seidel(exact.problem, settings(kFull, spin ? 1e-5 : 1e-8)).converged);
    const auto error = [&](const SolverCase<Law>& c) {
        double sum = 0.0;
        for (std::size_t i = 0; i < w.state.bodies.size(); ++i)
            sum += (c.velocity(i) - exact.velocity(i)).squaredNorm();
        return std::sqrt(sum / static_cast<double>(w.state.bodies.size()));
    };
    for (const double tolerance : {1e-2, 1e-3}) {
        SolverCase<Law> in_double(w), mixed(w);
        gauss_seidel(in_double.problem, settings(kFull, tolerance));
        const SolveReport report = gauss_seidel(mixed.problem, settings(kMixed, tolerance));
        EXPECT_TRUE(report.converged);
        EXPECT_LE(report.residual.rms, tolerance);
        EXPECT_LE(report.residual.max, 16.0 * tolerance);
        EXPECT_FALSE(mixed.problem.single());
        EXPECT_EQ(mixed.problem.residual().rms, report.residual.rms);
        EXPECT_NE(mixed.velocity(0), in_double.velocity(0));
        EXPECT_LT(error(mixed), 1.5 * error(in_double));
    }
}
TEST(SingleProblem, TheSolutionIsThatInDoublePrecision) {
    expect_the_solution<Frictional>(true);
    expect_the_solution<Frictionless>(false);
}

// Signorini's and Coulomb's inequalities in double precision, with sliding contacts on the cone, not near it; and
// velocities that are those of the impulses.
TEST(SingleProblem, ImpulsesAreInTheirCones) {
    SmallScene w(kStep, 0.4);
    bed(w, 12, true);
    SolverCase<Frictional> c(w);
    ASSERT_TRUE(gauss_seidel(c.problem, settings(kMixed)).converged);
    std::vector<Vec3> p, dv(w.state.bodies.size(), Vec3::Zero());
    std::vector<double> none;
    c.problem.impulses(p, none);
    int open = 0, sticking = 0, sliding = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        const contact::Contact& contact = c.contacts[k];
        const double pn = p[k].dot(contact.normal), pt = (p[k] - pn * contact.normal).norm();
        if (pn > 0.0) {
            EXPECT_LE(pt, (1.0 + 1e-14) * contact.friction * pn);
            const bool slides = pt > (1.0 - 1e-9) * contact.friction * pn;
            const bool nearly = pt > (1.0 - 1e-7) * contact.friction * pn;
            EXPECT_EQ(slides, nearly);
            ++(slides ? sliding : sticking);
        } else {
            EXPECT_EQ(p[k], Vec3(Vec3::Zero()));
            ++open;
        }
        dv[contact.a] += p[k] / w.mass(contact.a);
        if (!contact.key.is_wall()) dv[contact.b] -= p[k] / w.mass(contact.b);
    }
    EXPECT_GT(open, 10);
    EXPECT_GT(sticking, 10);
    EXPECT_GT(sliding, 10);
    for (std::size_t i = 0; i < dv.size(); ++i)
        EXPECT_LT((c.velocity(i) - (w.velocity(i) + c.dv_free + dv[i])).norm(), 1e-14);
}

// Sizes and speeds far from 1 leave the bits of the numbers as they are.
TEST(SingleProblem, ScaledScenesGiveScaledBits) {
    SmallScene one(kStep, 0.4);
    bed(one, 8, true);
    SolverCase<Frictional> expected(one);
    const SolveReport report = gauss_seidel(expected.problem, settings(kMixed));
    for (const int k : {-20, -10, 5}) {  // lengths of 2^-40 to 2^10
        SmallScene w(kStep, 0.4);
        bed(w, 8, true, k);
        SolverCase<Frictional> c(w);
        const SolveReport scaled = gauss_seidel(c.problem, settings(kMixed));
        EXPECT_EQ(scaled.sweeps, report.sweeps);
        EXPECT_EQ(scaled.residual.rms, report.residual.rms);
        for (std::size_t i = 0; i < one.state.bodies.size(); ++i)
            EXPECT_EQ(c.velocity(i), Vec3(std::ldexp(1.0, k) * expected.velocity(i)));
    }
}

// Beyond the limits `mixed` gives the bits of `double`.
TEST(SingleProblem, BeyondItsLimitsNothingChanges) {
    const auto expect_same = [](const SmallScene& w, double tolerance) {
        SolverCase<Frictional> in_double(w), mixed(w);
        const SolveReport expected = gauss_seidel(in_double.problem, settings(kFull, tolerance));
        const SolveReport report = gauss_seidel(mixed.problem, settings(kMixed, tolerance));
        EXPECT_EQ(report.sweeps, expected.sweeps);
        EXPECT_EQ(report.residual.rms, expected.residual.rms);
        for (std::size_t i = 0; i < w.state.bodies.size(); ++i) EXPECT_EQ(mixed.velocity(i), in_double.velocity(i));
    };
    SmallScene w(kStep, 0.4);
    bed(w, 8, true);
    expect_same(w, 5e-4);
    for (Vec3& v : w.state.bodies.velocity) v += Vec3(1e4, 0, 0);  // a bed that passes by
    w.scene.walls.clear();
    expect_same(w, 1e-2);
    SmallScene heavy(kStep, 0.4);
    bed(heavy, 8, true);
    heavy.state.bodies.mass[200] *= 1e7;
    expect_same(heavy, 1e-2);
    // and inside them it does
    SmallScene usual(kStep, 0.4);
    bed(usual, 8, true);
    SolverCase<Frictional> in_double(usual), mixed(usual);
    gauss_seidel(in_double.problem, settings(kFull));
    gauss_seidel(mixed.problem, settings(kMixed));
    EXPECT_NE(mixed.velocity(0), in_double.velocity(0));
}

}  // namespace
}  // namespace scree::solvers
