// Inlets and outlets by themselves.
#include "solvers/flows.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "solvers/energy.hpp"
#include "tests/testing/small_scene.hpp"

namespace scree::solvers {
namespace {

using testing::SmallScene;

Inlet inlet_of(double rate) {
    Inlet inlet;
    inlet.region = {Vec3(0, 0, 0), Vec3(1, 1, 1)};
    inlet.size = UniformSize{0.05, 0.1};
    inlet.mass_rate = rate;
    inlet.velocity = Vec3(0, 0, -2);
    return inlet;
}
void ready(SmallScene& w) {
    w.state.inlets.resize(w.scene.inlets.size());
    w.state.outlets.resize(w.scene.outlets.size());
}
double mass_of(const Bodies& b) {
    double sum = 0.0;
    for (const double m : b.mass) sum += m;
    return sum;
}

TEST(Inlet, MakesWhatItOwesAndNothingOverlaps) {
    SmallScene w(1.0);
    w.scene.inlets.push_back(inlet_of(100.0));
    w.add_floor();
    w.add(Vec3(0.5, 0.5, 0.5), 0.2);
    const double before = mass_of(w.state.bodies);
    ready(w);
    w.state.time = 0.5;
    const Plan plan = make_plan(w.scene, w.state.bodies);
    EXPECT_TRUE(make_bodies(w.scene, plan, w.state));
    const Bodies& b = w.state.bodies;
    const double heaviest = Bodies::sphere_mass(0.05, 2500.0);
    EXPECT_LE(w.state.inlets[0].mass, 50.0);
    EXPECT_GT(w.state.inlets[0].mass, 50.0 - heaviest);
    EXPECT_NEAR(mass_of(b) - before, w.state.inlets[0].mass, 1e-12);
    EXPECT_EQ(b.size(), 1 + w.state.inlets[0].bodies);
    EXPECT_TRUE(std::is_sorted(b.id.begin(), b.id.end()));
    double energy = 0.0;
    for (std::size_t i = 1; i < b.size(); ++i) {
        EXPECT_EQ(b.velocity[i], Vec3(0, 0, -2));
        EXPECT_GE(b.radius[i], 0.025);
        EXPECT_LE(b.radius[i], 0.05);
        EXPECT_GE(b.position[i].minCoeff(), b.radius[i]);  // inside the box, and off the floor
        EXPECT_LE(b.position[i].maxCoeff(), 1.0 - b.radius[i]);
        for (std::size_t j = 0; j < i; ++j)
            ASSERT_GE((b.position[i] - b.position[j]).norm(), b.radius[i] + b.radius[j]);
        energy += energy_of(b, i, Vec3(0, 0, -9.81));
    }
    EXPECT_NEAR(w.state.ledger[Work::inlets], energy, 1e-10);
}

TEST(Inlet, KeepsItsTimesAndItsLimit) {
    SmallScene w(1.0);
    Inlet inlet = inlet_of(10.0);
    inlet.from = 1.0;
    inlet.until = 3.0;
    w.scene.inlets.push_back(inlet);
    inlet.until = kForever;
    inlet.max_mass = 5.0;
    inlet.region = {Vec3(2, 0, 0), Vec3(3, 1, 1)};
    w.scene.inlets.push_back(inlet);
    ready(w);
    const Plan plan = make_plan(w.scene, w.state.bodies);
    const double heaviest = Bodies::sphere_mass(0.05, 2500.0);
    w.state.time = 0.9;
    EXPECT_FALSE(make_bodies(w.scene, plan, w.state));
    for (const auto& [time, first, second] : {std::array{1.25, 2.5, 2.5}, {2.0, 10.0, 5.0}, {9.0, 20.0, 5.0}}) {
        w.state.time = time;
        make_bodies(w.scene, plan, w.state);
        EXPECT_LE(w.state.inlets[0].mass, first);
        EXPECT_GT(w.state.inlets[0].mass, first - heaviest);
        EXPECT_LE(w.state.inlets[1].mass, second);
        EXPECT_GT(w.state.inlets[1].mass, second - heaviest);
    }
}

// What does not fit now is owed, not lost: it comes when there is room.
TEST(Inlet, OwesWhatHasNoRoom) {
    SmallScene w(1.0);
    Inlet inlet = inlet_of(1e4);
    inlet.size = FixedSize{0.3};
    inlet.max_mass = 20.5 * Bodies::sphere_mass(0.15, 2500.0);
    w.scene.inlets.push_back(inlet);
    ready(w);
    const Plan plan = make_plan(w.scene, w.state.bodies);
    w.state.time = 10.0;
    make_bodies(w.scene, plan, w.state);
    const std::uint64_t first = w.state.inlets[0].bodies;
    EXPECT_GT(first, 3U);
    EXPECT_LT(first, 20U);
    for (Vec3& x : w.state.bodies.position) x.z() -= 5.0;
    for (int k = 0; k < 10; ++k) {
        make_bodies(w.scene, plan, w.state);
        for (Vec3& x : w.state.bodies.position) x.z() -= 5.0;
    }
    EXPECT_EQ(w.state.inlets[0].bodies, 20U);
}

TEST(Inlet, TheSameSeedMakesTheSameBodies) {
    const auto made = [](std::uint64_t seed) {
        SmallScene w(1.0);
        w.scene.seed = seed;
        w.scene.inlets.push_back(inlet_of(50.0));
        ready(w);
        w.state.time = 1.0;
        make_bodies(w.scene, make_plan(w.scene, w.state.bodies), w.state);
        return w.state.bodies.position;
    };
    EXPECT_EQ(made(5), made(5));
    EXPECT_NE(made(5), made(6));
}

TEST(Inlet, FrictionAndOrientationGetTheirArrays) {
    SmallScene w(1.0, 0.3);
    w.scene.inlets.push_back(inlet_of(50.0));
    w.scene.output.fields = {"orientation"};
    ready(w);
    w.state.time = 1.0;
    make_bodies(w.scene, make_plan(w.scene, w.state.bodies), w.state);
    EXPECT_GT(w.state.bodies.size(), 0U);
    EXPECT_EQ(w.state.bodies.spin.size(), w.state.bodies.size());
    EXPECT_EQ(w.state.bodies.orientation.size(), w.state.bodies.size());
}

TEST(Outlet, TakesWhatIsInItsRegionWhileItIsOpen) {
    SmallScene w(1.0);
    for (int i = 0; i < 6; ++i) w.add(Vec3(i, 0, 0), 0.1, Vec3(0, 1, 0));
    w.state.bodies.spin.assign(6, Vec3(0, 0, 3));
    w.scene.outlets.push_back({"right", HalfSpaceRegion{Vec3(2.5, 0, 0), -Vec3::UnitX()}, 1.0, 2.0});
    w.scene.outlets.push_back({"also", BoxRegion{Vec3(3.5, -1, -1), Vec3(9, 1, 1)}, 0.5, kForever});
    ready(w);
    w.state.time = 0.4;
    EXPECT_FALSE(take_bodies(w.scene, w.state));
    w.state.time = 1.0;
    double energy = 0.0;
    for (std::size_t i = 3; i < 6; ++i) energy += energy_of(w.state.bodies, i, w.scene.gravity.at(0.0));
    EXPECT_TRUE(take_bodies(w.scene, w.state));
    EXPECT_EQ(w.state.outlets[0].bodies, 3U);  // each body goes once, by the first outlet that has it
    EXPECT_EQ(w.state.outlets[1].bodies, 0U);
    EXPECT_NEAR(w.state.outlets[0].mass, 3 * w.mass(0), 1e-12);
    EXPECT_NEAR(w.state.ledger[Work::outlets], -energy, 1e-12);
    EXPECT_EQ(w.state.bodies.id, (std::vector{BodyId{0}, BodyId{1}, BodyId{2}}));
    for (const std::size_t n :
         {w.state.bodies.radius.size(), w.state.bodies.mass.size(), w.state.bodies.material.size(),
          w.state.bodies.position.size(), w.state.bodies.velocity.size(), w.state.bodies.spin.size()})
        EXPECT_EQ(n, 3U);
    EXPECT_EQ(w.position(2), Vec3(2, 0, 0));
    w.position(0).x() = 5.0;
    w.state.time = 2.0;
    EXPECT_TRUE(take_bodies(w.scene, w.state));  // the first is closed again, the second takes it
    EXPECT_EQ(w.state.outlets[1].bodies, 1U);
}

}  // namespace
}  // namespace scree::solvers
