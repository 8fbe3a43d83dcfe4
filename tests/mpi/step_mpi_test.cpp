// Random small scenes on the ranks of this run and on one: the same bits after every step, the same sweeps, the same
// residuals. Blocks are tiny, so that bodies cross borders all the time; some scenes have bodies much wider than a
// block.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "core/parallel/communicator.hpp"
#include "core/state_hash.hpp"
#include "solvers/energy.hpp"
#include "solvers/stepper.hpp"
#include "tests/mpi/dealt.hpp"
#include "tests/testing/height_grid.hpp"

namespace scree {
namespace {

using testing::Ghosts;
using testing::share;
using testing::SmallScene;
using testing::world;

struct Run {
    Scene scene;
    State state;
    Plan plan;
    std::unique_ptr<solvers::Stepper> stepper;

    Run(const SmallScene& w, const Communicator& ranks) : scene(w.scene), state(w.state) {
        plan = make_plan(scene, w.state.bodies);
        if (plan.friction) state.bodies.spin = w.given_spins;
        if (!ranks.alone()) state.bodies = share(state.bodies, 0, Ghosts::none);
        state.inlets.resize(scene.inlets.size());
        state.outlets.resize(scene.outlets.size());
        state.measures.resize(scene.measures.size());
        solvers::start_ledger(scene, state, ranks);
        stepper = std::make_unique<solvers::Stepper>(scene, plan, ranks);
    }
};

double uniform(std::mt19937_64& draw, double low, double high) {
    return low + (high - low) * static_cast<double>(draw() >> 11) * 0x1p-53;
}

// A loose heap in a box that is shaken; sizes from 1:1 to 1:20, blocks from half a box to a few small bodies.
SmallScene random_scene(unsigned seed) {
    std::mt19937_64 draw(seed);
    SmallScene w(uniform(draw, 2e-4, 2e-3), seed % 3 == 0 ? 0.0 : uniform(draw, 0.1, 1.0), uniform(draw, 0.0, 0.9));
    w.scene.solver = SolverSettings{};
    w.scene.solver.tolerance = seed % 5 == 0 ? 1e-6 : 1e-2;
    w.scene.solver.max_sweeps = 60;
    w.scene.correction.on = seed % 4 != 3;
    w.gravity(Vec3(uniform(draw, -2, 2), uniform(draw, -2, 2), -9.81));
    const double small = 0.01, ratio = seed % 2 == 0 ? 1.5 : uniform(draw, 4.0, 20.0);
    const int count = static_cast<int>(uniform(draw, 1, 120));
    const double side = small * uniform(draw, 8, 20);
    for (int i = 0; i < count; ++i) {
        const bool large = ratio > 2.0 && i < 3;
        const double r = large ? 0.5 * small * ratio : small * uniform(draw, 0.7, 1.3);
        const Vec3 x(uniform(draw, -side, side), uniform(draw, -side, side), uniform(draw, 0.0, 2 * side));
        const Vec3 v(uniform(draw, -3, 3), uniform(draw, -3, 3), uniform(draw, -3, 3));
        w.add(x, r, v, 10.0 * v);
    }
    WallMotion motion;
    if (seed % 3 == 1) {
        motion.amplitude = Vec3(0.3 * small, 0, 0.5 * small);
        motion.frequency = 40.0;
    }
    w.add_wall(BoxWall{Vec3(-side, -side, -small), Vec3(side, side, 4 * side), true, false, false}, motion);
    if (seed % 2 == 0) w.scene.solver.block_size = small * uniform(draw, 3.0, 8.0);
    return w;
}

// The first body of this rank that is not as it should be, and what is near; empty if there is none.
std::string first_difference(const State& one, const State& many) {
    const Bodies& b = many.bodies;
    for (std::size_t i = 0; i < b.size(); ++i) {
        const auto at = std::lower_bound(one.bodies.id.begin(), one.bodies.id.end(), b.id[i]);
        const auto j = static_cast<std::size_t>(at - one.bodies.id.begin());
        if (b.position[i] == one.bodies.position[j] && b.velocity[i] == one.bodies.velocity[j]) continue;
        std::ostringstream text;
        text << (b.is_ghost(i) ? "ghost " : "body ") << raw(b.id[i]) << ", radius " << b.radius[i] << ", block "
             << many.block_size << ", x " << b.position[i].transpose() << ", off by "
             << (b.position[i] - one.bodies.position[j]).norm() << " m and "
             << (b.velocity[i] - one.bodies.velocity[j]).norm() << " m/s";
        return text.str();
    }
    return {};
}

// `left`: bodies at the end.
void same_steps(const SmallScene& w, int steps, unsigned seed, std::uint64_t& left) {
    Run one(w, Communicator::self()), many(w, world());
    for (int k = 0; k < steps; ++k) {
        const StepReport a = one.stepper->advance(one.state), b = many.stepper->advance(many.state);
        ASSERT_EQ(state_hash(one.state.bodies), state_hash(many.state.bodies, world()))
            << "scene " << seed << ", step " << k << ": " << first_difference(one.state, many.state);
        ASSERT_EQ(a.sweeps, b.sweeps) << "scene " << seed << ", step " << k;
        ASSERT_EQ(a.residual_rms, b.residual_rms);
        ASSERT_EQ(a.residual_max, b.residual_max);
        ASSERT_EQ(a.contacts, b.contacts);
        ASSERT_EQ(a.active, b.active);
        ASSERT_EQ(a.penetration.max, b.penetration.max);
        ASSERT_EQ(a.penetration.mean, b.penetration.mean);
        ASSERT_EQ(a.momentum_error, b.momentum_error);
        ASSERT_EQ(one.state.ledger.kinetic, many.state.ledger.kinetic);
        ASSERT_EQ(one.state.ledger.work, many.state.ledger.work);
        ASSERT_EQ(one.stepper->wall_loads()[0].impulse, many.stepper->wall_loads()[0].impulse);
        ASSERT_EQ(one.state.bodies.owned(), world().sum(static_cast<std::uint64_t>(many.state.bodies.owned())));
    }
    left = one.state.bodies.size();
}

TEST(StepOnRanks, RandomScenesHaveTheSameBits) {
    // many ranks on few cores wait for each other
    const unsigned scenes = world().size() <= 3 ? 200 : 40;
    for (unsigned seed = 0; seed < scenes; ++seed) {
        std::uint64_t left = 0;
        same_steps(random_scene(seed), 25, seed, left);
        if (HasFatalFailure()) return;
    }
}

// The same heaps fall on noise, of cells from a tenth of a body to ten bodies, with a hole and with either border.
TEST(StepOnRanks, RandomScenesOnTerrainHaveTheSameBits) {
    const unsigned scenes = world().size() <= 3 ? 60 : 15;
    for (unsigned seed = 0; seed < scenes; ++seed) {
        SmallScene w = random_scene(seed);
        const BoxWall box = std::get<BoxWall>(w.scene.walls[0].shape);
        std::mt19937_64 draw(seed);
        const double side = box.upper.x(),
                     cell = std::max(0.01 * std::pow(10.0, uniform(draw, -1.0, 1.0)), side / 80.0);
        HeightGrid grid =
            testing::noisy_grid(static_cast<std::uint32_t>(2.4 * side / cell) + 3, cell, 0.5 * cell, seed);
        if (seed % 3 != 0) grid.height[grid.height.size() / 2] = testing::kNoData;
        const TerrainBorder border = seed % 2 == 0 ? TerrainBorder::open : TerrainBorder::closed;
        w.scene.walls.clear();
        w.add_wall(testing::wall_of(grid, border));
        for (Vec3& x : w.state.bodies.position) x.z() += 0.5 * cell + 0.03;
        std::uint64_t left = 0;
        same_steps(w, 120, seed, left);
        if (HasFatalFailure()) return;
    }
}

// Halos and lists that outlive many steps, while bodies leave in the middle of the heap and fast ones kick others.
TEST(StepOnRanks, LongRunsWithAnOutletHaveTheSameBits) {
    std::uint64_t taken = 0;
    for (unsigned seed = 1000; seed < (world().size() <= 3 ? 1024U : 1006U); ++seed) {
        SmallScene w = random_scene(seed);
        const double half = 0.02 + 0.01 * (seed % 4);
        w.scene.outlets.push_back(
            {"sink", BoxRegion{Vec3(-half, -half, -1.0), Vec3(half, half, 0.012)}, 0.02, kForever});
        std::uint64_t left = 0;
        same_steps(w, 250, seed, left);
        if (HasFatalFailure()) return;
        taken += w.state.bodies.size() - left;
    }
    EXPECT_GT(taken, 20U);
}

}  // namespace
}  // namespace scree
