// What a scene does not need is not there: arrays, bytes, kernels; and a step in steady state allocates nothing.
#include <gtest/gtest.h>

#include "core/state_hash.hpp"
#include "solvers/rigid_kernels.hpp"
#include "solvers/substep.hpp"
#include "tests/testing/count_allocations.hpp"
#include "tests/testing/rigid_contacts.hpp"
#include "tests/testing/world.hpp"

namespace scree::solvers {
namespace {

using testing::World;

// A settled block of 8 x 8 x 4 balls on a floor, at the default settings.
void heap(World& w) {
    w.scene.solver = SolverSettings{};
    w.scene.correction.on = true;
    for (int i = 0; i < 256; ++i) w.add(Vec3(0.2 * (i % 8), 0.2 * (i / 8 % 8), 0.1 + 0.2 * (i / 64)), 0.1);
    w.add_wall(BoxWall{Vec3(-0.1, -0.1, 0), Vec3(1.5, 1.5, 9), true, false, false});
}

TEST(PlanCosts, FrictionlessScenesHaveNoSpinAndNoVectors) {
    World w(1e-3, 0.0);
    heap(w);
    w.run(20);
    EXPECT_FALSE(w.plan.friction);
    EXPECT_EQ(w.state.bodies.spin.capacity(), 0U);
    EXPECT_EQ(w.state.bodies.orientation.capacity(), 0U);
    EXPECT_EQ(w.state.warm_start.impulse_vector.capacity(), 0U);
    EXPECT_GE(w.state.warm_start.impulse_normal.size(), 256U);
    EXPECT_TRUE(w.stepper->contacts().empty());
    EXPECT_EQ(w.stepper->contacts().capacity(), 0U);
}

TEST(PlanCosts, FrictionalScenesHaveNoNumbers) {
    World w(1e-3, 0.5);
    heap(w);
    w.run(20);
    EXPECT_EQ(w.state.bodies.spin.size(), 256U);
    EXPECT_EQ(w.state.warm_start.impulse_normal.capacity(), 0U);
    EXPECT_GE(w.state.warm_start.impulse_vector.size(), 256U);
}

TEST(PlanCosts, BytesOfALineAndAContact) {
    EXPECT_EQ(sizeof(ContactProblem<Frictionless>::Line), 32U);
    EXPECT_EQ(sizeof(ContactProblem<Frictional>::Line), 64U);
    EXPECT_LE(sizeof(FrictionlessBatch), 64U * kLanes);
    EXPECT_LE(sizeof(FrictionBatch), 96U * kLanes);
    World with(1e-3, 0.5), without(1e-3, 0.0);
    heap(with);
    heap(without);
    with.run(20);
    without.run(20);
    EXPECT_LT(static_cast<double>(without.stepper->bytes()), 0.85 * static_cast<double>(with.stepper->bytes()));
}

// The frictionless step alone, which knows no frictional kernel, gives the bits of the stepper: nothing else ran.
TEST(PlanCosts, FrictionlessScenesRunTheFrictionlessStep) {
    World w(1e-3, 0.0), alone(1e-3, 0.0);
    heap(w);
    heap(alone);
    w.run(30);
    alone.start();
    Domain domain;
    alone.state.block_size = choose_block_size(alone.state.bodies);
    Substep<Frictionless> substep(alone.scene, alone.plan, domain);
    std::vector<WallLoad> loads(alone.scene.walls.size());
    for (int k = 0; k < 30; ++k) {
        alone.state.time = k * 1e-3;
        alone.state.step = static_cast<std::uint64_t>(k);
        substep.advance(alone.state, 1e-3, loads);
    }
    EXPECT_EQ(state_hash(w.state.bodies), state_hash(alone.state.bodies));
    EXPECT_EQ(w.state.warm_start.impulse_normal, alone.state.warm_start.impulse_normal);
}

// Bodies at rest keep their list of candidates; what a step needs was allocated in the first steps.
TEST(PlanCosts, AStepInSteadyStateAllocatesNothing) {
    for (const double mu : {0.0, 0.5}) {
        World w(1e-3, mu);
        heap(w);
        w.run(200);
        const std::size_t before = testing::allocations;
        w.run(50);
        EXPECT_EQ(testing::allocations - before, 0U) << "mu " << mu;
    }
}

// The kernels of bodies of any shape, among them needles, whose slips need many iterations.
TEST(PlanCosts, RigidKernelsAllocateNothing) {
    testing::RigidContacts c(1, testing::Shape::needle, 0.5);
    const Pack zero = Pack::all(0.0);
    const std::size_t before = testing::allocations;
    double sum = 0.0;
    for (int k = 0; k < 10; ++k) {
        sum += sum_lanes(update<false>(c.friction, c.line.data(), nullptr, zero));
        sum += sum_lanes(update<false>(c.frictionless, c.line.data(), nullptr, zero));
        sum += sum_lanes(natural_map(c.friction, c.line.data()) + natural_map(c.frictionless, c.line.data()));
        set_lane(c.friction, k % kLanes, c.data[0], c.line[1], c.line[2]);
    }
    EXPECT_EQ(testing::allocations, before);
    EXPECT_GT(sum, 0.0);
}

}  // namespace
}  // namespace scree::solvers
