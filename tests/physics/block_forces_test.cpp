// What contacts between blocks carry: sums and moments, which are unique where single corners are not.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/testing/closed_forms.hpp"
#include "tests/testing/solids.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::box;
using testing::cube;
using testing::kGravity;
using testing::World;

// Sum of what the contacts do to the upper one of two bodies and its moment about a point.
struct Carried {
    Vec3 impulse = Vec3::Zero(), moment = Vec3::Zero();
};
// `pick` tells the sign of a contact's impulse: 1, -1 or 0.
template <class Pick>
Carried carried(const World& w, const Vec3& about, const Pick& pick) {
    Carried sum;
    for (const ContactRecord& c : w.stepper->contacts()) {
        const double sign = pick(c.key);
        sum.impulse += sign * c.impulse / c.step;
        sum.moment += sign * (c.point - about).cross(c.impulse) / c.step;
    }
    return sum;
}

// Interface k carries the weight above it, with the pressure below the centre. The residual is 1e-13 of g h a contact,
// and errors of N interfaces above each other add up to at most N^2 times that.
TEST(BlockForces, EachInterfaceOfAStackCarriesTheWeightAbove) {
    const int n = 10;
    const double side = 0.1;
    for (const double mu : {0.0, 0.5}) {
        World w(1e-3, mu);
        w.scene.output.contacts = true;
        for (int i = 0; i < n; ++i) w.add(cube(side), Vec3(0, 0, side * (i + 0.5)));
        w.add_floor();
        w.run(50);
        ASSERT_TRUE(w.report.converged);
        const double weight = w.mass() * kGravity;
        for (int i = 0; i < n; ++i) {
            SCOPED_TRACE(i);
            // of a pair the normal points to the one with the lower id
            const std::uint64_t upper = static_cast<std::uint64_t>(i);
            const Carried c = carried(w, Vec3(0, 0, side * i), [&](const ContactKey& key) {
                if (i == 0) return key.is_wall() ? 1.0 : 0.0;
                return !key.is_wall() && key.a == upper - 1 && key.b == upper ? -1.0 : 0.0;
            });
            EXPECT_LT((c.impulse / weight - Vec3(0, 0, n - i)).norm(), 1e-10);
            EXPECT_LT(c.moment.norm() / (weight * side), 1e-10);
        }
        EXPECT_LT(w.fastest(), 1e-12);
    }
}

// A plate on four cubes with a weight beside its middle: statics gives the sum and the two moments, the four loads are
// not unique.
TEST(BlockForces, ATableOnFourLegsBalancesItsLoad) {
    World w(1e-3, 0.5);
    w.scene.output.contacts = true;
    const double leg = 0.1, thick = 0.05;
    for (const double x : {-0.45, 0.45})
        for (const double y : {-0.25, 0.25}) w.add(cube(leg), Vec3(x, y, 0.5 * leg));
    w.add(box(Vec3(1.0, 0.6, thick)), Vec3(0, 0, leg + 0.5 * thick));
    const Vec3 beside(0.2, -0.1, leg + thick + 0.1);
    w.add(cube(0.2), beside);
    w.add_floor();
    w.run(100);
    ASSERT_TRUE(w.report.converged);
    const double plate = w.mass(4) * kGravity, load = w.mass(5) * kGravity;
    const Carried c = carried(w, Vec3(0, 0, leg), [&](const ContactKey& key) {
        return !key.is_wall() && key.a < 4 && key.b == 4 ? -1.0 : 0.0;
    });
    EXPECT_LT((c.impulse - Vec3(0, 0, plate + load)).norm(), 1e-10 * (plate + load));
    // (x, y, 0) x (0, 0, F) = (y F, -x F, 0)
    EXPECT_NEAR(c.moment.x(), beside.y() * load, 1e-10 * load);
    EXPECT_NEAR(c.moment.y(), -beside.x() * load, 1e-10 * load);
    EXPECT_NEAR(c.moment.z(), 0.0, 1e-10 * load);
    EXPECT_LT(w.fastest(), 1e-11);
}

}  // namespace
}  // namespace scree
