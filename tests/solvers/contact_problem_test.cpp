// The contact problem: what is put in, what its velocities and impulses are, and what they conserve.
#include "solvers/contact_problem.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "solvers/energy.hpp"
#include "tests/testing/solver_case.hpp"

namespace scree::solvers {
namespace {

using testing::SmallScene;
using testing::SolverCase;

// A loose random heap above a floor; with spins if asked for.
void heap(SmallScene& w, int count, bool spin, std::uint64_t seed = 1) {
    Random random(seed, 1, 0);
    const auto vector = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
    for (int i = 0; i < count; ++i) {
        w.add(Vec3(random.uniform(), random.uniform(), 0.5 * random.uniform()), random.uniform(0.08, 0.15), vector());
        if (spin) w.state.bodies.spin.push_back(5.0 * vector());
    }
    w.add_floor();
}

Vec3 momentum(const Bodies& b) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < b.size(); ++i) sum += b.mass[i] * b.velocity[i];
    return sum;
}

TEST(ContactProblem, StartsFromTheFreeVelocities) {
    SmallScene w(1e-2, 0.3);
    heap(w, 30, true);
    SolverCase<Frictional> c(w);
    for (std::size_t i = 0; i < 30; ++i) {
        const SpinningLine& line = c.problem.line_of(i);
        for (int d = 0; d < 3; ++d) {
            EXPECT_EQ(line.v[d], w.velocity(i)[d] + c.dv_free[d]);
            EXPECT_EQ(line.w[d], w.radius(i) * w.spin(i)[d]);
        }
        EXPECT_EQ(line.inverse_mass, 1.0 / w.mass(i));
        EXPECT_DOUBLE_EQ(line.inverse_inertia, 2.5 / w.mass(i));  // R^2 / (2/5 m R^2)
    }
    EXPECT_EQ(c.problem.contacts(), c.contacts.size());
    EXPECT_EQ(c.problem.lines().size(), 31U);  // the ground first; walls at rest need no line of their own
    EXPECT_EQ(c.problem.lines()[kGround].inverse_mass, 0.0);
}

TEST(ContactProblem, SweepsConserveMomentumAndAngularMomentumOfContacts) {
    SmallScene w(1e-2, 0.5);
    heap(w, 60, true);
    w.scene.walls.clear();
    w.gravity(Vec3::Zero());
    SolverCase<Frictional> c(w);
    ASSERT_GT(c.contacts.size(), 50U);
    const Vec3 before = momentum(w.state.bodies);
    for (int k = 0; k < 20; ++k) c.problem.sweep(0.0, false);
    State after = w.state;
    c.problem.velocities(after);
    EXPECT_LT((momentum(after.bodies) - before).norm(), 1e-12);  // 60 kg at 1 m/s, some thousand updates
    // about the contact points: centres change by r x p, spins by (-R n) x p each, R n from the centre to the surface
    std::vector<Vec3> p;
    std::vector<double> none;
    c.problem.impulses(p, none);
    Vec3 turned = Vec3::Zero(), expected = Vec3::Zero();
    for (std::size_t i = 0; i < 60; ++i)
        turned += 0.4 * w.mass(i) * w.radius(i) * w.radius(i) * (after.bodies.spin[i] - w.spin(i));
    for (std::size_t k = 0; k < p.size(); ++k)
        expected -= (w.radius(c.contacts[k].a) + w.radius(c.contacts[k].b)) * c.contacts[k].normal.cross(p[k]);
    EXPECT_LT((turned - expected).norm(), 1e-12);
}

TEST(ContactProblem, WarmStartAddsTheImpulses) {
    SmallScene w(1e-2, 0.5);
    heap(w, 40, true);
    SolverCase<Frictional> c(w);
    Random random(4, 1, 0);
    std::vector<Vec3> given;
    for (std::size_t k = 0; k < c.contacts.size(); ++k)
        given.push_back(random.uniform() * c.contacts[k].normal + 0.1 * Vec3(random.normal(), random.normal(), 0));
    c.problem.warm_start(given, {});
    std::vector<Vec3> p, dv(40, Vec3::Zero());
    std::vector<double> none;
    c.problem.impulses(p, none);
    EXPECT_EQ(p, given);
    EXPECT_TRUE(none.empty());
    for (std::size_t k = 0; k < given.size(); ++k) {
        dv[c.contacts[k].a] += given[k] / w.mass(c.contacts[k].a);
        if (!c.contacts[k].key.is_wall()) dv[c.contacts[k].b] -= given[k] / w.mass(c.contacts[k].b);
    }
    for (std::size_t i = 0; i < 40; ++i) EXPECT_LT((c.velocity(i) - (w.velocity(i) + c.dv_free + dv[i])).norm(), 1e-13);
}

// The work on the mean velocities is the change of kinetic energy without the forces' share, whatever the impulses.
template <class Law>
void expect_work_is_energy(bool spin) {
    SmallScene w(1e-2, spin ? 0.4 : 0.0, 0.3);
    heap(w, 50, spin);
    SolverCase<Law> c(w);
    for (int k = 0; k < 3; ++k) c.problem.sweep(0.0, false);  // not converged: it holds all the same
    State after = w.state;
    c.problem.velocities(after);
    std::array<ExactSum, 3> sums;
    c.problem.add_work(w.state, sums);
    const double normal = sums[0].value(), tangential = sums[1].value(), gained = sums[2].value();
    double by_gravity = 0.0;
    for (std::size_t i = 0; i < 50; ++i)
        by_gravity += 0.5 * w.mass(i) * c.dv_free.dot(w.velocity(i) + after.bodies.velocity[i]);
    const double change = kinetic_energy(after.bodies) - kinetic_energy(w.state.bodies);
    EXPECT_NEAR(normal + tangential + by_gravity, change, 1e-13 * kinetic_energy(w.state.bodies));
    EXPECT_LT(normal, 0.0);
    EXPECT_GE(gained, 0.0);
    if (!spin) {
        EXPECT_EQ(tangential, 0.0);
    }
}
TEST(ContactProblem, WorkIsTheChangeOfEnergy) {
    expect_work_is_energy<Frictional>(true);
    expect_work_is_energy<Frictionless>(false);
}

TEST(ContactProblem, MovingWallsPushWithTheirVelocity) {
    SmallScene w(1e-2, 0.0);
    w.gravity(Vec3::Zero());
    w.add(Vec3(0, 0, 0.1), 0.1);
    w.add(Vec3(1, 0, 0.1), 0.1);
    w.add_floor();
    SolverCase<Frictionless> c(w, Vec3(0, 0, 2));
    EXPECT_EQ(c.problem.lines().size(), 5U);  // ground, two bodies, one line a contact with a wall that moves
    for (int k = 0; k < 3; ++k) c.problem.sweep(0.0, false);
    EXPECT_EQ(c.velocity(0), Vec3(0, 0, 2));
    EXPECT_EQ(c.velocity(1), Vec3(0, 0, 2));
    EXPECT_EQ(c.problem.residual().max, 0.0);
}

TEST(ContactProblem, TheReferenceVelocityHasAFloor) {
    SmallScene w(1e-2, 0.0);
    w.add(Vec3(0, 0, 0.1), 0.1, Vec3(0, 0, 0.0981));  // its free velocity is 0
    w.add_floor();
    SolverCase<Frictionless> c(w);
    ASSERT_EQ(c.problem.contacts(), 1U);
    EXPECT_DOUBLE_EQ(c.problem.reference_velocity(), 0.0981);
    w.velocity() = Vec3(0, 0, -3);
    SolverCase<Frictionless> fast(w);
    EXPECT_DOUBLE_EQ(fast.problem.reference_velocity(), 3.0981);
}

}  // namespace
}  // namespace scree::solvers
