// Small random scenes: 2 to 6 bodies, any friction, restitution, step, size and mass. What no scene may do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::World;

TEST(Fuzz, InvariantsOfRandomScenes) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed, 77, 0);
        const auto vector = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
        const double mu = random.uniform() < 0.3 ? 0.0 : std::exp(random.uniform(-4.0, 3.0));
        const double e = random.uniform() < 0.3 ? 0.0 : random.uniform();
        World w(std::exp(random.uniform(-9.0, -3.0)), mu, e);
        w.scene.solver = SolverSettings{};
        w.scene.solver.max_sweeps = 300;
        w.scene.correction.on = random.uniform() < 0.7;
        if (random.uniform() < 0.2) w.gravity(Vec3::Zero());
        const int count = 2 + static_cast<int>(random.uniform(0.0, 5.0));
        for (int i = 0; i < count; ++i) {
            const double r = std::exp(random.uniform(-4.0, -1.0));
            w.add(Vec3(0, 0, 0.5) + 0.3 * vector(), r, vector(), 5.0 * vector(), std::exp(random.uniform(-5.0, 5.0)));
        }
        w.add_wall(BoxWall{Vec3(-1, -1, 0), Vec3(1, 1, 2), true, random.uniform() < 0.5, false});
        w.add_wall(CylinderWall{Vec3(0, 0, -1), Vec3(0, 0.6, 0.8), 0.05, 3.0, false});
        w.start();
        for (int k = 0; k < 150; ++k) {
            ASSERT_NO_THROW(w.step()) << "seed " << seed;
            const Ledger& l = w.state.ledger;
            ASSERT_TRUE(std::isfinite(w.energy())) << "seed " << seed;
            ASSERT_LT(l.drift(), 1e-10) << "seed " << seed << " step " << k;
            // each sweep adds round-off of the impulses, which may be far larger than what the bodies keep
            ASSERT_LE(w.report.momentum_error, 1e-14 * std::max(100, w.report.sweeps))
                << "seed " << seed << " step " << k;
            const double given = std::max(0.0, l[Work::correction]) + l.gained;
            const double scale = std::max(l.kinetic_max, l.potential_max - l.potential_min);
            ASSERT_LE(w.energy(), l.kinetic_0 + l.potential_0 + given + 1e-9 * scale + 1e-12) << "seed " << seed;
            ASSERT_TRUE(!w.report.converged || w.report.residual_rms <= w.scene.solver.tolerance) << "seed " << seed;
        }
    }
}

}  // namespace
}  // namespace scree
