// Bodies that come and go, and runs that are cut in two.
#include <gtest/gtest.h>

#include "core/random.hpp"
#include "core/state_hash.hpp"
#include "tests/testing/world.hpp"

namespace scree {
namespace {

using testing::World;

// A stream from an inlet through a hole in a floor to an outlet.
void stream(World& w) {
    Inlet inlet;
    inlet.name = "in";
    inlet.region = {Vec3(-0.15, -0.15, 0.5), Vec3(0.15, 0.15, 0.7)};
    inlet.size = UniformSize{0.02, 0.04};
    inlet.mass_rate = 5.0;
    inlet.velocity = Vec3(0, 0, -1);
    inlet.max_mass = 4.0;
    w.scene.inlets.push_back(inlet);
    w.scene.outlets.push_back({"out", HalfSpaceRegion{Vec3(0, 0, -0.3), Vec3::UnitZ()}});
    w.add_wall(OrificeFloor{Vec3::Zero(), Vec3::UnitZ(), 0.08});
    w.add_wall(CylinderWall{Vec3::Zero(), Vec3::UnitZ(), 0.25, kForever, true});
    w.scene.solver.tolerance = 1e-6;
    w.scene.correction.on = true;
}

TEST(Stream, MassAndEnergyBalance) {
    World w(1e-3, 0.3, 0.3);
    stream(w);
    for (int k = 0; k < 1200; ++k) {
        w.step();
        double inside = 0.0;
        for (const double m : w.state.bodies.mass) inside += m;
        const InletState& in = w.state.inlets[0];
        const OutletState& out = w.state.outlets[0];
        ASSERT_NEAR(in.mass, inside + out.mass, 1e-12);
        ASSERT_EQ(in.bodies, w.state.bodies.size() + out.bodies);
        ASSERT_LE(in.mass, std::min(5.0 * w.state.time, 4.0) + 1e-12);
        ASSERT_EQ(w.state.bodies.spin.size(), w.state.bodies.size());
    }
    const double heaviest = Bodies::sphere_mass(0.02, 2500.0);
    EXPECT_GT(w.state.inlets[0].mass, 4.0 - heaviest);  // all that was asked for, but for less than one body
    EXPECT_GT(w.state.outlets[0].bodies, 10U);
    EXPECT_LT(w.state.ledger.drift(), 1e-10);
    EXPECT_LT(w.state.totals.momentum_error_max, 1e-12);
    EXPECT_GT(w.state.ledger[Work::inlets], 0.0);
}

// The state is all that a restart needs: the second half from a copy gives the same bits.
void expect_same_after_restart(World& w, World& again, int first, int second) {
    w.run(first);
    again.state = w.state;
    again.plan = w.plan;
    again.stepper = std::make_unique<solvers::Stepper>(again.scene, again.plan);
    for (int k = 0; k < second; ++k) {
        w.step();
        again.step();
        ASSERT_EQ(state_hash(w.state.bodies), state_hash(again.state.bodies)) << "step " << k;
    }
    EXPECT_EQ(w.state.warm_start.impulse_vector, again.state.warm_start.impulse_vector);
    EXPECT_EQ(w.state.ledger.work, again.state.ledger.work);
    EXPECT_EQ(w.state.totals.sweeps, again.state.totals.sweeps);
}

TEST(Restart, OfAStreamGivesTheSameBits) {
    World w(1e-3, 0.3, 0.3), again(1e-3, 0.3, 0.3);
    stream(w);
    stream(again);
    expect_same_after_restart(w, again, 437, 300);
}

TEST(Restart, OfAHeapWithFastAndSlowBodiesGivesTheSameBits) {
    World w(1e-3, 0.5), again(1e-3, 0.5);
    for (World* x : {&w, &again}) {
        Random random(6, 1, 0);
        for (int i = 0; i < 300; ++i)
            x->add(Vec3(0.12 * (i % 5), 0.12 * (i / 5 % 5), 0.06 + 0.12 * (i / 25)), random.uniform(0.03, 0.06),
                   Vec3(random.normal(), random.normal(), i == 77 ? 150.0 : 0.0));
        x->add_wall(BoxWall{Vec3(-0.06, -0.06, 0), Vec3(0.54, 0.54, 1.6), true, false, false});
        WallMotion shake;
        shake.amplitude = Vec3(0, 0, 0.02);
        shake.frequency = 4.0;
        x->add_wall(DiscWall{Vec3(0.2, 0.2, 0.02), Vec3::UnitZ(), 0.1}, shake);
        x->scene.solver = SolverSettings{};
        x->scene.correction.on = true;
    }
    expect_same_after_restart(w, again, 100, 100);
    EXPECT_GT(w.state.totals.substepped, 0U);
}

}  // namespace
}  // namespace scree
