// Dry masonry of blocks, with the solver's settings as a run has them that sets nothing: what stands stays, for ten
// seconds here and for sixty in the slow tests.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/testing/closed_forms.hpp"
#include "tests/testing/solids.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::box;
using testing::cube;
using testing::hexahedron;
using testing::kGravity;
using testing::World;

constexpr double kSide = 0.1, kStep = 1e-3;

double farthest(const World& w, const std::vector<Vec3>& from) {
    double way = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) way = std::max(way, (w.state.bodies.position[i] - from[i]).norm());
    return way;
}

// Built where it stands exactly. In the first steps the solver has to find the impulses: the velocities that it leaves
// push blocks into one another by parts of the 5e-5 diameters that the correction of positions leaves alone, so over
// `courses` blocks above each other the drift may be that often this depth; but it must end: in the second half of the
// time nothing moves by more than a tenth of it.
void expect_rest(World& w, double seconds, int courses) {
    w.start();
    const double diameter = 2.0 * *std::max_element(w.state.bodies.radius.begin(), w.state.bodies.radius.end());
    const double sink = 5e-5 * diameter * courses;
    const std::vector<Vec3> built = w.state.bodies.position;
    const int half = static_cast<int>(std::lround(0.5 * seconds / w.scene.time.step));
    w.run(half);
    const std::vector<Vec3> settled = w.state.bodies.position;
    EXPECT_LT(farthest(w, built), sink);
    double fastest = 0.0;
    for (int k = 0; k < half; ++k) {
        w.step();
        fastest = std::max(fastest, w.fastest());
    }
    EXPECT_LT(fastest, 1e-4);
    EXPECT_LT(farthest(w, settled), 0.1 * sink);
    EXPECT_LE(w.state.totals.penetration_max_relative, 1e-4);
    EXPECT_LE(w.energy(), w.state.ledger.potential_0 * (1 + 1e-9));
}

void column(World& w, int count) {
    for (int i = 0; i < count; ++i) w.add(cube(kSide), Vec3(0, 0, kSide * (i + 0.5)));
    w.add_floor();
}
// Cubes in rows of `base`, `base` - 1, ... 1.
void pyramid(World& w, int base) {
    for (int row = 0; row < base; ++row)
        for (int i = 0; i < base - row; ++i) w.add(cube(kSide), kSide * Vec3(i + 0.5 * row, 0.0, row + 0.5));
    w.add_floor();
}
// Courses of blocks 2 : 1 : 1 in running bond, half blocks at the ends of every other one.
void wall(World& w, int courses) {
    const Vec3 whole(2 * kSide, kSide, kSide);
    for (int row = 0; row < courses; ++row) {
        const double z = kSide * (row + 0.5);
        const bool odd = row % 2 == 1;
        for (int i = odd ? 1 : 0; i < courses; ++i) w.add(box(whole), Vec3(whole.x() * (odd ? i : i + 0.5), 0.0, z));
        if (!odd) continue;
        w.add(cube(kSide), Vec3(0.5 * kSide, 0.0, z));
        w.add(cube(kSide), Vec3(whole.x() * courses - 0.5 * kSide, 0.0, z));
    }
    w.add_floor();
}

// Two cards that lean against each other: feet cut level, heads cut upright, so that both meet in faces. In the plane a
// card is a right triangle with the legs `base` and `height`, scaled by `thick` about its right angle, without itself.
struct Cards {
    double base, height, thick;

    // The least thrust at the head, by the weight of a card: the head pushes at its top, the foot stands on its inner
    // edge. So much friction must the floor have.
    double least_friction() const {
        const double k = thick, centre = base / 3.0 * (k * k * k - 1.0) / (k * k - 1.0);
        return (base - centre) / (k * height);
    }
    void build(World& w) const {
        for (const double side : {-1.0, 1.0})
            w.add(hexahedron([&](const Vec3& v) {
                      const double k = v.x() * side > 0.0 ? thick : 1.0;
                      return v.z() > 0.0 ? Vec3(0.0, 0.3 * v.y(), k * height) : Vec3(side * k * base, 0.3 * v.y(), 0.0);
                  }),
                  Vec3::Zero());
        w.add_floor();
    }
};

TEST(Masonry, AColumnOfTwentyCubesStands) {
    World w(kStep, 0.6);
    w.standard_settings();
    column(w, 20);
    expect_rest(w, 10.0, 20);
}

TEST(Masonry, APyramidStands) {
    World w(kStep, 0.6);
    w.standard_settings();
    pyramid(w, 8);
    expect_rest(w, 10.0, 8);
}

TEST(Masonry, AWallStands) {
    World w(kStep, 0.6);
    w.standard_settings();
    wall(w, 8);
    expect_rest(w, 4.0, 8);
}

TEST(Masonry, ACardHouseStandsAboveTheLimitOfFrictionAndFallsBelow) {
    const Cards cards{0.5, 0.8, 1.1};
    for (const double share : {1.03, 0.97}) {
        World w(kStep, cards.least_friction() * share);
        w.standard_settings();
        cards.build(w);
        if (share > 1.0) {
            expect_rest(w, 10.0, 1);
        } else {
            const double height = w.position().z();
            w.run(3000);
            EXPECT_LT(w.position().z(), 0.5 * height);
        }
    }
}

// The velocities that the solver leaves add up over the cubes: solved to the 1e-2 of the settings by default this one
// sways by 1 to 2 cm/s. So it is solved to 1e-6.
TEST(Masonry, AColumnOfFiftyCubesStands) {
    World w(kStep, 0.6);
    w.standard_settings();
    w.scene.solver.tolerance = 1e-6;
    w.scene.solver.max_sweeps = 5000;
    column(w, 50);
    expect_rest(w, 10.0, 50);
}

TEST(Masonry, DISABLED_AMinute) {
    {
        SCOPED_TRACE("wall");
        World w(kStep, 0.6);
        w.standard_settings();
        wall(w, 20);
        expect_rest(w, 60.0, 20);
    }
    {
        SCOPED_TRACE("pyramid");
        World w(kStep, 0.6);
        w.standard_settings();
        pyramid(w, 10);
        expect_rest(w, 60.0, 10);
    }
}

}  // namespace
}  // namespace scree
