// A semicircular arch of n equal voussoirs with radial joints (Couplet 1730; Heyman 1966): how thin it may be. With
// friction that keeps joints from sliding, limit analysis (the line of thrust within the arch at every joint) gives the
// least thickness by the radius of the centre line: 0.1075 for a continuous arch (Milankovitch 1907). Hinges only at
// joints make it lower, and not in order of n. The numbers are those of the linear programme of limit analysis, for
// voussoirs with straight edges, whose centre of mass lies at 2/3 (r2^3 - r1^3) / (r2^2 - r1^2) cos(pi / 2n).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/testing/solids.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::hexahedron;
using testing::World;

struct Arch {
    int voussoirs;
    double least;  // thickness by radius
};
constexpr Arch kArches[] = {{7, 0.095703}, {9, 0.101525}, {11, 0.104589}, {15, 0.106068}, {20, 0.107348}};

// Of radius 1 m and 0.3 m deep, on the floor z = 0.
void build(World& w, int voussoirs, double thickness) {
    const double half = 0.5 * std::numbers::pi / voussoirs;
    for (int k = 0; k < voussoirs; ++k) {
        const double middle = (2 * k + 1) * half - 0.5 * std::numbers::pi;  // from the vertical
        w.add(hexahedron([&](const Vec3& v) {
                  const double angle = middle + half * v.x(), r = 1.0 + 0.5 * thickness * v.z();
                  return Vec3(r * std::sin(angle), 0.15 * v.y(), r * std::cos(angle));
              }),
              Vec3::Zero());
    }
    w.add_floor();
}

// With the solver's settings as a run has them that sets nothing. So near the limit the thrust at the hinges passes
// within (share - 1) times the thickness of the edge, 0.3 mm here; overlaps are below a hundredth of that.
TEST(Arch, StandsJustAboveTheLeastThickness) {
    for (const Arch& arch : kArches) {
        SCOPED_TRACE(arch.voussoirs);
        World w(1e-3, 0.7);
        w.standard_settings();
        build(w, arch.voussoirs, 1.003 * arch.least);
        w.start();
        const std::vector<Vec3> built = w.state.bodies.position;
        w.run(2000);
        double fastest = 0.0;
        for (int k = 2000; k < 10000; ++k) {
            w.step();
            fastest = std::max(fastest, w.fastest());
        }
        EXPECT_LT(fastest, 1e-4);
        for (std::size_t i = 0; i < built.size(); ++i) EXPECT_LT((w.position(i) - built[i]).norm(), 5e-5);
    }
}

TEST(Arch, FallsJustBelowTheLeastThickness) {
    for (const Arch& arch : kArches) {
        SCOPED_TRACE(arch.voussoirs);
        World w(1e-3, 0.7);
        w.standard_settings();
        build(w, arch.voussoirs, 0.997 * arch.least);
        w.run(5000);
        double highest = 0.0;
        for (const Vec3& x : w.state.bodies.position) highest = std::max(highest, x.z());
        EXPECT_LT(highest, 0.5);
        EXPECT_LT(w.energy(), w.state.ledger.potential_0);
    }
}

}  // namespace
}  // namespace scree
