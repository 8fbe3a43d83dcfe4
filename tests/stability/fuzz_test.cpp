// Small random scenes: 2 to 6 bodies, any friction, restitution, step, size and mass. What no scene may do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "tests/testing/solids.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::World;

// Adds so many bodies and the walls.
template <class AddBody>
void fill(World& w, Random& random, const AddBody& add_body) {
    w.scene.solver = SolverSettings{};
    w.scene.solver.max_sweeps = 300;
    w.scene.correction.on = random.uniform() < 0.7;
    if (random.uniform() < 0.2) w.gravity(Vec3::Zero());
    const int count = 2 + static_cast<int>(random.uniform(0.0, 5.0));
    for (int i = 0; i < count; ++i) add_body();
    w.add_wall(BoxWall{Vec3(-1, -1, 0), Vec3(1, 1, 2), true, random.uniform() < 0.5, false});
    w.start();
}

void keeps_invariants(World& w, std::uint64_t seed) {
    for (int k = 0; k < 150; ++k) {
        ASSERT_NO_THROW(w.step()) << "seed " << seed;
        const Ledger& l = w.state.ledger;
        ASSERT_TRUE(std::isfinite(w.energy())) << "seed " << seed;
        ASSERT_LT(l.drift(), 1e-10) << "seed " << seed << " step " << k;
        // each sweep adds round-off of the impulses, which may be far larger than what the bodies keep
        ASSERT_LE(w.report.momentum_error, 1e-14 * std::max(100, w.report.sweeps)) << "seed " << seed << " step " << k;
        const double given = std::max(0.0, l[Work::correction]) + l.gained + std::max(0.0, l[Work::rotation]);
        const double scale = std::max(l.kinetic_max, l.potential_max - l.potential_min);
        ASSERT_LE(w.energy(), l.kinetic_0 + l.potential_0 + given + 1e-9 * scale + 1e-12) << "seed " << seed;
        ASSERT_TRUE(!w.report.converged || w.report.residual_rms <= w.scene.solver.tolerance) << "seed " << seed;
    }
}

double some_friction(Random& random) {
    return random.uniform() < 0.3 ? 0.0 : std::exp(random.uniform(-4.0, 3.0));
}
double some_restitution(Random& random) {
    return random.uniform() < 0.3 ? 0.0 : random.uniform();
}
Vec3 some_vector(Random& random) {
    return {random.normal(), random.normal(), random.normal()};
}

TEST(Fuzz, InvariantsOfRandomScenes) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed, 77, 0);
        const double mu = some_friction(random), e = some_restitution(random);
        World w(std::exp(random.uniform(-9.0, -3.0)), mu, e);
        w.add_wall(CylinderWall{Vec3(0, 0, -1), Vec3(0, 0.6, 0.8), 0.05, 3.0, false});
        fill(w, random, [&] {
            const double r = std::exp(random.uniform(-4.0, -1.0));
            w.add(Vec3(0, 0, 0.5) + 0.3 * some_vector(random), r, some_vector(random), 5.0 * some_vector(random),
                  std::exp(random.uniform(-5.0, 5.0)));
        });
        keeps_invariants(w, seed);
        if (HasFatalFailure()) return;
    }
}

// Boxes from needles to plates, among spheres, about a fixed box.
TEST(Fuzz, InvariantsOfRandomScenesOfPolyhedra) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed, 78, 0);
        const double mu = some_friction(random), e = some_restitution(random);
        World w(std::exp(random.uniform(-9.0, -3.0)), mu, e);
        w.add_wall(BoxWall{Vec3(-0.2, -0.3, -2.0), Vec3(0.3, 0.2, 0.3), false, false, false});
        fill(w, random, [&] {
            const Vec3 x = Vec3(0, 0, 0.7) + 0.3 * some_vector(random);
            if (random.uniform() < 0.25) {
                w.add(x, std::exp(random.uniform(-4.0, -1.0)), some_vector(random), 5.0 * some_vector(random));
                return;
            }
            const Vec3 sides(std::exp(random.uniform(-4.0, -1.0)), std::exp(random.uniform(-4.0, -1.0)),
                             std::exp(random.uniform(-4.0, -1.0)));
            const Quat turn(random.normal(), random.normal(), random.normal(), random.normal());
            w.add(testing::box(sides), x, turn.normalized(), some_vector(random), 5.0 * some_vector(random));
        });
        keeps_invariants(w, seed);
        if (HasFatalFailure()) return;
    }
}

}  // namespace
}  // namespace scree
