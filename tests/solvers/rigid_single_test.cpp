// Bodies of any shape in single precision: the kernels against those in double precision, and whole sweeps.
#include <gtest/gtest.h>

#include <array>

#include "solvers/gauss_seidel.hpp"
#include "tests/testing/rigid_bed.hpp"
#include "tests/testing/rigid_contacts.hpp"
#include "tests/testing/solver_case.hpp"
#include "tests/testing/some_rotation.hpp"

namespace scree::solvers {
namespace {

using testing::RigidContacts, testing::Shape, testing::SlowRigidContact;
using Real = SlowRigidContact::Real;

// The contacts of two batches side by side, as two blocks would lie.
struct Halves {
    std::array<RigidLineOf<float>, 2 * RigidContacts::kBodies + 1> line{};
    RigidFrictionalBatchOf<float> friction{};
    RigidFrictionlessBatchOf<float> frictionless{};

    Halves(const RigidContacts& first, const RigidContacts& second, const SingleUnits& unit) {
        int lane = 0;
        for (const RigidContacts* of : {&first, &second}) {
            const std::uint32_t bodies = lane == 0 ? 0 : RigidContacts::kBodies;
            to_single(friction, of->friction, lane, unit);
            to_single(frictionless, of->frictionless, lane, unit);
            for (std::size_t k = 1; k < of->line.size(); ++k) to_single(line[bodies + k], of->line[k], unit);
            for (int i = lane; i < lane + kLanes; ++i)
                for (std::uint32_t* side : {friction.a, friction.b, frictionless.a, frictionless.b})
                    if (side[i] != kGround) side[i] += bodies;
            lane += kLanes;
        }
    }
};

constexpr Real kRound = 1.2e-7L;

// Sums in a contact, in units of velocity: with the numbers of double precision, what single precision rounds.
Real size_of(const SlowRigidContact& before, const SlowRigidContact& after) {
    return before.size_of_velocity() + after.size_of_velocity() +
           after.size_of_delassus() * (before.p.norm() + after.p.norm());
}

constexpr std::array kFrictions{0.0, 0.05, 0.5, 1.0, 10.0};

// The natural map, in double precision, of what single precision takes for the solution.
TEST(RigidSingle, UpdateIsTheSolutionToSinglePrecision) {
    for (const Shape shape : {Shape::sphere, Shape::grain, Shape::plate})
        for (const double mu : kFrictions)
            for (std::uint64_t seed = 0; seed < 200; ++seed) {
                const RigidContacts first(seed, shape, mu, 0.5), second(seed + 1000, shape, mu, 0.5);
                Halves single(first, second, {});
                update<false>(single.friction, single.line.data(), nullptr, PackF::all(0.0F));
                update<false>(single.frictionless, single.line.data(), nullptr, PackF::all(0.0F));
                for (int half = 0; half < 2; ++half) {
                    const RigidContacts& of = half == 0 ? first : second;
                    RigidContacts now = of;
                    for (int i = 0; i < kLanes; ++i)
                        for (int d = 0; d < 3; ++d) now.friction.p[d][i] = single.friction.p[d][half * kLanes + i];
                    into_cone(now.friction);
                    for (int i = 0; i < kLanes; ++i) {
                        const SlowRigidContact old = of.slow(i);
                        SlowRigidContact c = old;
                        c.p = now.slow(i).p;
                        c.push(c.p - old.p);
                        const auto r = old.reduced();
                        const Real pn = now.friction.p[0][i], pt = now.tangential(i).norm();
                        const Real grows = 1 + (r.s > 0 ? (1 + c.mu * r.k.norm()) * pn / r.s : 0);
                        EXPECT_LE(c.natural_map(), 30 * kRound * size_of(old, c) * (1 + c.mu) * grows) << "mu " << mu;
                        EXPECT_GE(pn, 0);
                        EXPECT_LE(pt, c.mu * pn * (1 + 1e-14L));
                        EXPECT_EQ(pt > c.mu * pn * (1 - 1e-7L), pt > c.mu * pn * (1 - 1e-14L)) << "nearly slips";
                    }
                }
            }
}

// Units are powers of two: they change exponents, not digits.
TEST(RigidSingle, UnitsChangeNoDigit) {
    const SingleUnits unit{0x1p-6, 0x1p9, 0x1p-8};
    for (const double mu : kFrictions)
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            const RigidContacts first(seed, Shape::grain, mu), second(seed + 50, Shape::plate, mu);
            Halves plain(first, second, {}), scaled(first, second, unit);
            const PackF zero = PackF::all(0.0F);
            update<false>(plain.friction, plain.line.data(), nullptr, zero);
            update<false>(scaled.friction, scaled.line.data(), nullptr, zero);
            update<false>(plain.frictionless, plain.line.data(), nullptr, zero);
            update<false>(scaled.frictionless, scaled.line.data(), nullptr, zero);
            for (int i = 0; i < kLanesSingle; ++i) {
                for (int d = 0; d < 3; ++d)
                    EXPECT_EQ(static_cast<double>(scaled.friction.p[d][i]) * unit.impulse(), plain.friction.p[d][i]);
                EXPECT_EQ(static_cast<double>(scaled.frictionless.p[0][i]) * unit.impulse(),
                          plain.frictionless.p[0][i]);
            }
            for (std::size_t k = 0; k < plain.line.size(); ++k)
                for (int d = 0; d < 3; ++d) {
                    EXPECT_EQ(static_cast<double>(scaled.line[k].v[d]) * unit.velocity, plain.line[k].v[d]);
                    EXPECT_EQ(static_cast<double>(scaled.line[k].w[d]) * (unit.velocity / unit.length),
                              plain.line[k].w[d]);
                }
        }
}

// One sweep from the same impulses does the same to round-off: no two contacts side by side share a body, and none is
// left out. Lengths times 4^k, times 2^k for time.
template <class Law>
void expect_the_same_sweep(int k) {
    const double h = std::ldexp(1e-3, k), unit = std::ldexp(1.0, 2 * k), speed = std::ldexp(0.02, k);
    testing::SmallScene w(h, Law::kImpulse == 3 ? 0.4 : 0.0);
    Random random(5, 1, 0);
    const auto vector = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
    for (int i = 0; i < 6 * 24 * 24; ++i) {
        const double radius = unit * random.uniform(0.0101, 0.0104);
        w.add(unit * 0.02 * Vec3(i % 24, i / 24 % 24, 0.5 + i / 576), radius, speed * vector());
        w.state.bodies.spin.push_back(speed / radius * vector());
    }
    w.add_floor();
    const contact::ContactSet contacts = testing::contacts_of(w);
    Layout layout;
    layout.arrange(contacts, w.state.bodies, choose_block_size(w.state.bodies));
    ASSERT_GT(layout.phase(0).end, 3U);  // blocks of one colour, to lie side by side
    Sweeps<Law, double> full =
        testing::rigid_bed<Law>(w.state.bodies, contacts, layout, Vec3(0.0, 0.0, -9.81 * h), testing::BedShape::grains);
    SingleProblem<Law> single;
    const double inverse_mass = full.line[1].inverse_mass;
    single.load(full, layout, {speed, inverse_mass, 1.0 / inverse_mass, 0.4, unit * 0.01}, speed);
    full.reset_momentum();
    single.sweeps.reset_momentum();
    const double to_velocity = single.velocity_unit() * single.velocity_unit();
    ExactSum in_double, in_single;
    for (int sweep = 0; sweep < 3; ++sweep) {
        full.sweep(layout, nullptr, layout.touched_lines(), 0.3, true, in_double);
        single.sweeps.sweep(single, nullptr, layout.touched_lines(), 0.3, true, in_single);
    }
    EXPECT_NEAR(in_single.value() * to_velocity, in_double.value(), 1e-5 * in_double.value());
    ExactSum of_double, of_single;
    const double largest = full.residual(layout, of_double);
    EXPECT_NEAR(single.sweeps.residual(single, of_single) * to_velocity, largest, 1e-4 * largest);
    EXPECT_NEAR(of_single.value() * to_velocity, of_double.value(), 1e-5 * of_double.value());
    EXPECT_GT(of_double.value(), 1e-6 * speed * speed * static_cast<double>(contacts.size()));
    Sweeps<Law, double> back = full;
    single.give_impulses(back);
    int pressed = 0;
    for (std::size_t b = 0; b < full.batch.size(); ++b)
        for (int i = 0; i < kLanes; ++i) {
            const Vec3 p = world_impulse(full.batch[b], i), q = world_impulse(back.batch[b], i);
            EXPECT_LE((p - q).norm(), 1e-5 * speed / inverse_mass);
            pressed += p.norm() > 1e-2 * speed / inverse_mass ? 1 : 0;
        }
    EXPECT_GT(pressed, 1000);
}
TEST(RigidSingle, ASweepIsThatInDoublePrecision) {
    for (const int k : {-5, 0, 5}) {
        expect_the_same_sweep<RigidFrictional>(k);
        expect_the_same_sweep<RigidFrictionless>(k);
    }
}

// The contact problem of a bed of ellipsoids, solved in single precision and then checked, or finished, in double.
template <class Law>
void expect_the_solution() {
    testing::SmallScene w(1e-3, Law::kImpulse == 3 ? 0.4 : 0.0);
    Random random(7, 1, 0);
    const auto vector = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
    Bodies& bodies = w.state.bodies;
    for (int i = 0; i < 6 * 12 * 12; ++i) {
        const double radius = random.uniform(0.0101, 0.0104);
        w.add(0.02 * Vec3(i % 12, i / 12 % 12, 0.5 + i / 144), radius, 0.02 * vector());
        bodies.spin.push_back(0.02 / radius * vector());
        bodies.orientation.push_back(testing::some_rotation(static_cast<std::uint64_t>(i)));
        bodies.inertia.push_back(bodies.mass.back() * radius * radius * Vec3(0.2, 0.272, 0.328));
    }
    w.add_floor();
    const contact::ContactSet contacts = testing::contacts_of(w);
    std::vector<Vec3> points;
    for (const contact::Contact& c : contacts)
        points.push_back(bodies.position[c.a] - 0.01 * c.normal + 0.003 * vector());
    Layout layout;
    layout.arrange(contacts, bodies, choose_block_size(bodies));
    const auto solved = [&](SolverPrecision precision, double tolerance, ContactProblem<Law>& problem) {
        const Vec3 dv(0.0, 0.0, -9.81e-3);
        problem.assemble(contacts, layout, w.state, dv, {}, points);
        problem.scale(dv.norm());
        SolverSettings s;
        s.precision = precision;
        s.tolerance = tolerance;
        s.max_sweeps = 5000;
        EXPECT_EQ(problem.begin_single(s), precision == SolverPrecision::mixed);
        return gauss_seidel(problem, s);
    };
    ContactProblem<Law> exact;
    ASSERT_TRUE(solved(SolverPrecision::full, 1e-6, exact).converged);
    const auto error = [&](const ContactProblem<Law>& problem) {
        double sum = 0.0;
        for (std::size_t i = 0; i < bodies.size(); ++i)
            for (int d = 0; d < 3; ++d) {
                const double v = problem.line_of(i).v[d] - exact.line_of(i).v[d];
                const double turn = bodies.radius[i] * (problem.line_of(i).w[d] - exact.line_of(i).w[d]);
                sum += v * v + turn * turn;
            }
        return std::sqrt(sum / static_cast<double>(bodies.size()));
    };
    for (const double tolerance : {1e-2, 1e-3}) {
        ContactProblem<Law> in_double, mixed;
        solved(SolverPrecision::full, tolerance, in_double);
        const SolveReport report = solved(SolverPrecision::mixed, tolerance, mixed);
        EXPECT_TRUE(report.converged);
        EXPECT_LE(report.residual.rms, tolerance);
        EXPECT_FALSE(mixed.single());
        EXPECT_EQ(mixed.residual().rms, report.residual.rms);
        EXPECT_NE(mixed.line_of(0).v[0], in_double.line_of(0).v[0]);
        EXPECT_LT(error(mixed), 1.5 * error(in_double));
    }
}
TEST(RigidSingle, TheSolutionIsThatInDoublePrecision) {
    expect_the_solution<RigidFrictional>();
    expect_the_solution<RigidFrictionless>();
}

}  // namespace
}  // namespace scree::solvers
