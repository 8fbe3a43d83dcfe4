// A free-standing block that rocks on its edges (Housner 1963). Half-width b, half-height H, R = sqrt(b^2 + H^2),
// alpha = atan(b / H), p^2 = 3 g / 4 R: between impacts th'' = -p^2 sin(alpha - |th|); at each impact the spin falls to
// r = 1 - 3/2 sin^2(alpha) of what it was, when all of the impulse acts at the edge that lands.
#include <gtest/gtest.h>

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

struct RockingBlock {
    double b, height;            // half [m]
    std::vector<double> impact;  // [s] from rest at alpha / 2, by integration of Housner's equation
    double alpha() const { return std::atan(b / height); }
    double ratio() const { return 1.0 - 1.5 * std::pow(std::sin(alpha()), 2); }
};
const RockingBlock kBlocks[] = {
    {0.10, 0.5, {0.347094, 0.950921, 1.487940, 1.972072, 2.412550}},
    {0.25, 1.0, {0.493803, 1.297470, 1.979391, 2.570721, 3.090349}},
};

// Starts at rest on one edge, leaning by alpha / 2. Friction 0.8 is above what the impact needs.
Quat lean(World& w, const RockingBlock& block) {
    const double angle = 0.5 * block.alpha();
    const Quat turn(Eigen::AngleAxisd(angle, Vec3::UnitY()));
    w.add(box(Vec3(2 * block.b, 0.4, 2 * block.height)), -(turn * Vec3(block.b, 0.0, -block.height)), turn);
    w.add_floor();
    return turn;
}

struct Impact {
    double time, ratio;
    double per_step;  // what gravity changes the spin by in a step, as a share of the spin before
};
// An impact is a change of sign of the lean, th. Its time: by a straight line through the lean of the steps before and
// after it. The spins are those two steps before and after it, brought to it by the acceleration p^2 sin(alpha).
std::vector<Impact> impacts(const RockingBlock& block, double h) {
    World w(h, 0.8);
    const Quat turn = lean(w, block);
    w.start();
    const Quat start = w.state.bodies.orientation[0];
    const double gravity = 0.75 * kGravity / std::hypot(block.b, block.height) * std::sin(block.alpha());
    std::vector<double> angle, spin;
    for (double t = 0.0; t < block.impact.back() + 0.2; t += h) {
        w.step();
        angle.push_back(2.0 * std::asin((w.state.bodies.orientation[0] * start.conjugate() * turn).y()));
        spin.push_back(w.spin().y());
    }
    EXPECT_LE(w.energy(), w.state.ledger.kinetic_0 + w.state.ledger.potential_0);
    std::vector<Impact> found;
    for (std::size_t k = 3; k + 3 < angle.size() && found.size() < block.impact.size(); ++k) {
        if (angle[k - 1] * angle[k] > 0.0) continue;
        const double part = angle[k - 1] / (angle[k - 1] - angle[k]);
        const double time = (static_cast<double>(k) + part) * h;  // angle[0] is that of h
        const double before = std::abs(spin[k - 3]) + gravity * (2.0 + part) * h;
        const double after = std::abs(spin[k + 2]) + gravity * (3.0 - part) * h;
        found.push_back({time, after / before, gravity * h / before});
    }
    return found;
}

// The edge that lands does so at the end of the step in which it would, and the other one carries nothing from the
// begin of this step on: the moment of the weight, for a step at most, has the other sign than in Housner's sequence.
// That changes the ratio by up to two such parts, and the impact read here up to a step too early by two more; the
// times of the later impacts have errors of order h.
TEST(Rocking, ImpactsAreHousners) {
    for (const RockingBlock& block : kBlocks)
        for (const double h : {1e-3, 5e-4, 1e-4}) {
            SCOPED_TRACE(block.b);
            SCOPED_TRACE(h);
            const std::vector<Impact> found = impacts(block, h);
            ASSERT_EQ(found.size(), block.impact.size());
            EXPECT_NEAR(found[0].time, block.impact[0], h);
            for (std::size_t k = 0; k < found.size(); ++k) {
                EXPECT_NEAR(found[k].ratio, block.ratio(), 4.0 * found[k].per_step);
                EXPECT_NEAR(found[k].time, block.impact[k], (h > 5e-4 ? 0.02 : 0.01) * block.impact[k]);
            }
            if (h < 5e-4) {
                EXPECT_NEAR(found[0].ratio, block.ratio(), 1e-3);
                EXPECT_NEAR(found.back().time, block.impact.back(), 3e-3 * block.impact.back());
            }
        }
}

}  // namespace
}  // namespace scree
