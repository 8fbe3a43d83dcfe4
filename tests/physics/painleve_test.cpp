// Painleve's paradox: a rod whose lower tip slides ahead of its centre of mass on a rough floor. Per unit of the normal
// force at the tip its normal acceleration is p / m,
//   p = 1 + (l^2 / k^2) cos(th) (cos(th) - mu sin(th)),   l from centre to tip, k the radius of gyration;
// with p < 0 no finite force keeps the tip out of the floor. At the level of impulses there is a solution: an impact
// without a fall, whose size does not depend on the step.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/testing/closed_forms.hpp"
#include "tests/testing/solids.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::box;
using testing::kGravity;
using testing::World;

constexpr double kSpeed = 3.0;  // [m/s] towards -x
const double kAngle = std::atan(2.0);

// The body, long in x and centred, so that its -x end stands on the floor and leads.
void slide(World& w, const Polyhedron& rod) {
    const Quat turn(Eigen::AngleAxisd(-kAngle, Vec3::UnitY()));
    double lowest = 0.0;
    for (const Vec3& v : rod.vertex) lowest = std::min(lowest, (turn * v).z());
    w.add(rod, Vec3(0, 0, -lowest), turn, Vec3(-kSpeed, 0, 0));
    w.add_floor();
}

// Two thin pyramids base to base, 2 l long: one point at the tip. k^2 = l^2 / 10 and a little for the thickness.
Polyhedron spindle(double l, double thin) {
    Polyhedron body;
    body.vertex = {Vec3(-l, 0, 0),   Vec3(l, 0, 0),     Vec3(0, -thin, 0),
                   Vec3(0, thin, 0), Vec3(0, 0, -thin), Vec3(0, 0, thin)};
    body.face = {{1, 3, 5}, {1, 5, 2}, {1, 2, 4}, {1, 4, 3}, {0, 5, 3}, {0, 2, 5}, {0, 4, 2}, {0, 3, 4}};
    return body;
}

// p = 1 + 10 (0.2 - 0.4 mu) < 0. In the first step the tip comes to rest: angular momentum about it is kept,
//   w (J + m l^2) = m (r x v),  r from the tip to the centre,  impulse = m (w x r - v),  v with the fall of the step.
TEST(Painleve, TheTipOfASpindleSticksInOneStep) {
    for (const double mu : {0.9, 1.0, 2.0})
        for (const double h : {1e-3, 1e-4, 1e-5, 1e-6}) {
            SCOPED_TRACE(mu);
            SCOPED_TRACE(h);
            const double l = 0.5;
            World w(h, mu);
            slide(w, spindle(l, 0.01));
            w.step();
            const double m = w.mass(), c = std::cos(kAngle), s = std::sin(kAngle);
            const double inertia = w.state.bodies.inertia[0].maxCoeff();
            const double vx = -kSpeed, vz = -kGravity * h;
            const double spin = m * l * (c * vz - s * vx) / (inertia + m * l * l);  // from x to z
            const Vec3 impulse = m * Vec3(-spin * l * s - vx, 0.0, spin * l * c - vz);
            ASSERT_LT(std::abs(impulse.x()), mu * impulse.z());
            EXPECT_LT((w.stepper->wall_loads()[0].impulse + impulse).norm(), 1e-9 * m * kSpeed);
            EXPECT_TRUE(w.report.converged);
            EXPECT_LT(w.energy(), w.state.ledger.kinetic_0 + w.state.ledger.potential_0);
        }
}

// A thin box stands on two corners, either of which may take the impact: several solutions. Whichever it is, the same
// one at every step but for what the body moves and falls in it, h (V / l) of the impulse.
TEST(Painleve, TheImpulseOnABoxConverges) {
    for (const double mu : {1.4, 1.5, 2.0}) {
        SCOPED_TRACE(mu);
        std::vector<double> largest;
        const std::array steps = {1e-3, 1e-4, 1e-5};
        for (const double h : steps) {
            SCOPED_TRACE(h);
            World w(h, mu);
            slide(w, box(Vec3(1.0, 0.02, 0.02)));
            w.start();
            const double energy = w.state.ledger.kinetic_0 + w.state.ledger.potential_0;
            double most = 0.0, last = energy;
            const int count = static_cast<int>(std::lround(0.05 / h));
            for (int k = 0; k < count; ++k) {
                w.step();
                most = std::max(most, w.stepper->wall_loads()[0].impulse.norm() / (w.mass() * kSpeed));
                EXPECT_LE(w.energy(), last + 1e-9 * energy);
                last = w.energy();
            }
            EXPECT_EQ(w.state.totals.steps_not_converged, 0U);
            EXPECT_LT(most, 1.0);
            largest.push_back(most);
        }
        const double l = 0.5;
        EXPECT_NEAR(largest[0], largest[2], steps[0] * kSpeed / l);
        EXPECT_NEAR(largest[1], largest[2], steps[1] * kSpeed / l);
    }
}

}  // namespace
}  // namespace scree
