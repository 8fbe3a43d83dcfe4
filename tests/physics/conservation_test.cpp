// What no step may change: free flight, energy and momentum of gases, the ledger's balance, units.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "tests/testing/closed_forms.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::kGravity;
using testing::World;

TEST(FreeFlight, IsTheParabola) {
    // theta = 1/2 integrates a constant force exactly: only the round-off of 1000 additions is left.
    World w(1e-3, 0.5);
    const Vec3 x0(1, -2, 3), v0(4, 5, 6), spin(7, 8, 9);
    w.add(x0, 0.1, v0, spin);
    w.add_wall(PlaneWall{Vec3(0, 0, -100), Vec3::UnitZ()});  // out of reach; it is there so that there is friction
    for (int k = 1; k <= 1000; ++k) {
        w.step();
        const double t = 1e-3 * k;
        ASSERT_LT((w.position() - (x0 + t * v0 + 0.5 * t * t * Vec3(0, 0, -kGravity))).norm(), k * 2e-15);
        ASSERT_LT((w.velocity() - (v0 + t * Vec3(0, 0, -kGravity))).norm(), k * 2e-15);
        ASSERT_EQ(w.spin(), spin);
        ASSERT_EQ(w.report.contacts, 0U);
        ASSERT_DOUBLE_EQ(w.state.time, t);
    }
    EXPECT_LT(w.state.ledger.drift(), 1e-13);
}

TEST(FreeFlight, EmptyScenesStepToo) {
    World w(1e-3);
    w.add_floor();
    w.run(5);
    EXPECT_EQ(w.state.step, 5U);
    EXPECT_EQ(w.report.bodies, 0U);
    EXPECT_TRUE(w.report.converged);
    EXPECT_EQ(w.state.ledger.drift(), 0.0);
    EXPECT_EQ(w.report.momentum_error, 0.0);
}

// `count` spheres on a lattice in the unit box, with random velocities of order 1.
void gas(World& w, int count, std::uint64_t seed) {
    Random random(seed, 1, 0);
    const int side = static_cast<int>(std::ceil(std::cbrt(count)));
    for (int i = 0; i < count; ++i) {
        const Vec3 cell(i % side, i / side % side, i / (side * side));
        w.add((cell + Vec3::Constant(0.5)) / side, 0.35 / side,
              Vec3(random.normal(), random.normal(), random.normal()));
    }
    w.add_wall(BoxWall{Vec3::Zero(), Vec3::Ones(), true, false, false});
}

TEST(Gas, ElasticSpheresKeepTheirKineticEnergy) {
    World w(1e-3, 0.0, 1.0);
    w.gravity(Vec3::Zero());
    gas(w, 200, 1);
    w.start();
    const double start = w.state.ledger.kinetic_0;
    std::uint64_t impulses = 0;
    for (int k = 0; k < 1500; ++k) impulses += w.step().active;
    EXPECT_GT(impulses, 20U * 200U);  // each has met others or a wall some twenty times
    EXPECT_NEAR(w.state.ledger.kinetic / start, 1.0, 1e-10);
    EXPECT_LT(w.state.totals.momentum_error_max, 1e-12);
    EXPECT_LT(w.state.ledger.drift(), 1e-10);
}

TEST(Gas, PlasticSpheresWithFrictionCloseTheLedger) {
    for (const double e : {0.0, 0.6}) {
        World w(1e-3, 0.4, e);
        w.scene.solver.tolerance = 1e-6;
        w.scene.correction.on = true;
        gas(w, 200, 2);
        w.start();
        double last = w.energy();
        for (int k = 0; k < 500; ++k) {
            const double corrected = w.state.ledger[Work::correction], gained = w.state.ledger.gained;
            w.step();
            // no step adds energy but by lifting bodies out of each other, or as the ledger says that a contact did
            const double given = w.state.ledger[Work::correction] - corrected + w.state.ledger.gained - gained;
            ASSERT_LE(w.energy(), last + std::max(given, 0.0) + 1e-10 * w.state.ledger.kinetic_0) << k;
            last = w.energy();
        }
        EXPECT_LT(w.state.ledger.drift(), 1e-10);
        EXPECT_LT(w.state.totals.momentum_error_max, 1e-12);
        EXPECT_LT(w.state.ledger[Work::friction], 0.0);
        EXPECT_LT(w.state.ledger[Work::restitution], 0.0);
    }
}

// Angular momentum about any point: contacts must act at one point for both bodies. Impulses act at q_m, where the
// contact's middle is the point of both to half the gap.
TEST(Gas, AngularMomentumOfTwoSpheres) {
    World w(1e-4, 0.5, 0.3);
    w.gravity(Vec3::Zero());
    w.add(Vec3(0, 0, 0), 0.1, Vec3(0, 0.2, 1), Vec3(1, 2, 3));
    w.add(Vec3(0.05, 0.1, 0.3), 0.15, Vec3(0.1, -0.3, -1), Vec3(-4, 0, 2));
    const auto angular = [&] {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < 2; ++i)
            sum += w.mass(i) * w.position(i).cross(w.velocity(i)) +
                   0.4 * w.mass(i) * w.radius(i) * w.radius(i) * w.spin(i);
        return sum;
    };
    w.start();
    const Vec3 before = angular(), momentum = w.momentum();
    double deepest = 0.0;
    std::size_t active = 0;
    for (int k = 0; k < 1000; ++k) {
        active += w.step().active;
        deepest = std::max(deepest, w.report.penetration.max);
    }
    EXPECT_GT(active, 0U);
    EXPECT_LT((w.momentum() - momentum).norm(), 1e-13 * w.mass(1));
    // levers are radii: off by half the overlap at the middle of the step, at most h v / 2 = 1e-4 m
    EXPECT_LT((angular() - before).norm(), 1e-4 * momentum.norm() + 1e-4 * w.mass(1));
    EXPECT_LE(deepest, 1e-4);
}

struct Shape {
    std::vector<Vec3> position, velocity, spin;
};
// A few spheres that drop into a corner, in lengths scaled by `unit`; times scale with its root.
Shape dropped(double unit, double mass_unit) {
    const double time = std::sqrt(unit);
    World w(1e-3 * time, 0.3, 0.4);
    w.scene.materials[0].density *= mass_unit / (unit * unit * unit);
    for (int i = 0; i < 3; ++i)
        w.add(unit * Vec3(0.1513 + 0.2137 * i, 0.1471, 0.2039 + 0.1093 * i), unit * (0.1 - 0.01 * i),
              unit / time * Vec3(-0.517, -0.219, 0));  // no impact falls on the border of a step
    w.add_wall(BoxWall{Vec3::Zero(), unit * Vec3(1, 1, 1), true, false, false});
    w.scene.correction.on = true;
    w.run(400);
    EXPECT_LT(w.state.ledger.drift(), 1e-10);
    EXPECT_EQ(w.state.totals.steps_not_converged, 0U);
    Shape s;
    for (std::size_t i = 0; i < 3; ++i) {
        s.position.push_back(w.position(i) / unit);
        s.velocity.push_back(w.velocity(i) * time / unit);
        s.spin.push_back(w.spin(i) * time);
    }
    return s;
}

// No absolute tolerance anywhere: lengths from micrometres to kilometres, masses from picograms, give the same numbers.
// The few impacts amplify round-off by some powers of ten; nothing is chaotic within this time.
TEST(Units, DimensionlessResultsDoNotDependOnThem) {
    const Shape reference = dropped(1.0, 1.0);
    for (const auto& [unit, mass] : {std::pair{1e-6, 1.0}, {1e3, 1.0}, {1.0, 1e-15}, {1e-6, 1e-15}, {1e3, 1e12}}) {
        const Shape s = dropped(unit, mass);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_LT((s.position[i] - reference.position[i]).norm(), 1e-9) << unit << ' ' << mass;
            EXPECT_LT((s.velocity[i] - reference.velocity[i]).norm(), 1e-9) << unit << ' ' << mass;
            EXPECT_LT((s.spin[i] - reference.spin[i]).norm(), 1e-8) << unit << ' ' << mass;
        }
    }
}

}  // namespace
}  // namespace scree
