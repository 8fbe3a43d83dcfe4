// The time step as a whole: time, substeps, reports, records, loads, overlaps, faults.
#include "solvers/stepper.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/state_hash.hpp"
#include "solvers/find_overlaps.hpp"
#include "tests/testing/world.hpp"

namespace scree::solvers {
namespace {

using testing::World;

TEST(Stepper, TimeIsTheNumberOfStepsTimesTheStep) {
    World w(1e-3);
    w.add(Vec3(0, 0, 5), 0.1);
    w.run(12345);
    EXPECT_EQ(w.state.step, 12345U);
    EXPECT_EQ(w.state.time, 12345 * 1e-3);  // no sum of round-off
    EXPECT_EQ(w.stepper->last_step(), 1e-3);
    EXPECT_EQ(w.state.totals.steps, 12345U);
}

// Two bodies, the faster at 5.2 radii a step: cut into 8, since 4 parts would be 1.3 radii each.
TEST(Stepper, FastBodiesCutTheStep) {
    World w(1e-2);
    w.gravity(Vec3::Zero());
    w.add(Vec3(0, 0, 0), 0.1, Vec3(52, 0, 0));
    w.add(Vec3(0, 5, 0), 0.2, Vec3(0, 0, 3));
    w.step();
    EXPECT_EQ(w.state.totals.steps, 8U);
    EXPECT_EQ(w.state.totals.substepped, 1U);
    EXPECT_EQ(w.state.step, 1U);
    EXPECT_NEAR(w.report.step, 1e-2, 1e-17);
    EXPECT_NEAR(w.position(0).x(), 0.52, 1e-15);
    w.scene.time.max_travel = 2.0;
    w.step();
    EXPECT_EQ(w.state.totals.steps, 12U);
    w.scene.time.max_travel = 0.0;
    w.step();
    EXPECT_EQ(w.state.totals.steps, 13U);
    EXPECT_EQ(w.state.totals.substepped, 2U);
}

TEST(Stepper, WallLoadsAddUpOverSubsteps) {
    World w(1e-2);
    w.scene.solver.tolerance = 1e-12;
    w.add(Vec3(0, 0, 0.1), 0.1);
    w.add(Vec3(3, 1, 0.2), 0.2);
    w.add(Vec3(50, 0, 50), 0.1, Vec3(60, 0, 0));  // far away and fast
    w.add_floor();
    w.run(3);
    EXPECT_EQ(w.state.totals.steps, 3U * 8U);
    const WallLoad& load = w.stepper->wall_loads().at(0);
    const double h_g = 9.81e-2, first = w.mass(0) * h_g, second = w.mass(1) * h_g;
    EXPECT_LT((load.impulse - Vec3(0, 0, -first - second)).norm(), 1e-10 * second);
    // about the origin: r x p with r = (3, 1, 0), p = (0, 0, -second)
    EXPECT_LT((load.angular - Vec3(-second, 3 * second, 0)).norm(), 1e-9 * second);
    EXPECT_EQ(load.contacts, 16U);
}

TEST(Stepper, RecordsAreMadeWhenAsked) {
    World silent(1e-3, 0.5);
    silent.add(Vec3(0, 0, 0.1), 0.1);
    silent.add_floor();
    silent.step();
    EXPECT_TRUE(silent.stepper->contacts().empty());
    World w(1e-3, 0.5);
    w.scene.output.contacts = true;
    w.add(Vec3(0, 0, 0.1), 0.1);                                  // rests
    w.add(Vec3(1, 0, 0.1), 0.1, Vec3(2, 0, 0));                   // slides
    w.add(Vec3(2, 0, 0.1), 0.1, Vec3(0.1, 0, 0), Vec3(0, 1, 0));  // rolls
    w.add_floor();
    w.step();
    const auto& records = w.stepper->contacts();
    ASSERT_EQ(records.size(), 3U);
    EXPECT_EQ(records[0].status, ContactStatus::sticking);
    EXPECT_EQ(records[1].status, ContactStatus::sliding);
    EXPECT_EQ(records[2].status, ContactStatus::sticking);
    EXPECT_EQ(records[1].normal, Vec3::UnitZ());
    EXPECT_NEAR(records[1].point.x(), 1.0 + 1e-3, 1e-12);  // middle of the step
    EXPECT_NEAR(records[1].point.z(), 0.0, 1e-12);
    EXPECT_NEAR(records[1].gap, 0.0, 1e-15);
    const double normal = w.mass() * 9.81e-3;
    EXPECT_NEAR(records[1].impulse.x(), -0.5 * normal, 1e-12 * normal);
    EXPECT_NEAR(records[1].impulse.z(), normal, 1e-12 * normal);
    EXPECT_EQ(records[1].step, 1e-3);
    EXPECT_LT(records[0].key, records[1].key);
}

TEST(Stepper, OrientationsFollowTheSpin) {
    World w(1e-3, 0.5);
    w.scene.output.fields = {"orientation"};
    w.gravity(Vec3::Zero());
    const Vec3 spin(3, -2, 5);
    w.add(Vec3(0, 0, 5), 0.1, Vec3::Zero(), spin);
    w.add_floor();
    w.state.bodies.orientation.assign(1, Quat::Identity());
    w.run(1000);
    const Quat expected(Eigen::AngleAxisd(spin.norm(), spin.normalized()));
    EXPECT_NEAR(w.state.bodies.orientation[0].angularDistance(expected), 0.0, 1e-7);  // acos near 1
    EXPECT_NEAR(w.state.bodies.orientation[0].norm(), 1.0, 1e-15);
}

TEST(Stepper, SpeedsThatAreNotFiniteEndTheRun) {
    World w(1e-3);
    w.add(Vec3(0, 0, 5), 0.1, Vec3(std::numeric_limits<double>::infinity(), 0, 0));
    EXPECT_THROW(w.step(), PhysicsError);
}

TEST(Stepper, TheSameSceneGivesTheSameBits) {
    const auto hash = [] {
        World w(1e-3, 0.3, 0.2);
        for (int i = 0; i < 30; ++i)
            w.add(Vec3(0.15 * (i % 3), 0.16 * (i / 3 % 3), 0.12 + 0.2 * (i / 9)), 0.09 + 1e-4 * i);
        w.add_floor();
        w.run(200);
        return state_hash(w.state.bodies);
    };
    EXPECT_EQ(hash(), hash());
}

TEST(FindOverlaps, DeeperThanTheShare) {
    World w(1e-3);
    w.add(Vec3(0, 0, 0.09), 0.1);    // 10 mm into the floor
    w.add(Vec3(0, 0, 0.285), 0.1);   // 5 mm into the first
    w.add(Vec3(0, 0, 0.4849), 0.1);  // 0.1 mm into the second
    w.add_floor();
    w.add_wall(PlaneWall{Vec3(0, 0, 0.2), Vec3::UnitZ()});
    w.scene.walls[1].appears = 1.0;  // not there yet
    const auto overlaps = find_overlaps(w.scene, w.state, 0.01);
    ASSERT_EQ(overlaps.size(), 2U);
    EXPECT_EQ(overlaps[0].key, ContactKey::bodies(BodyId{0}, BodyId{1}));
    EXPECT_NEAR(overlaps[0].depth, 0.005, 1e-15);
    EXPECT_NEAR(overlaps[0].point.z(), 0.1875, 1e-15);
    EXPECT_TRUE(overlaps[1].key.is_wall());
    EXPECT_NEAR(overlaps[1].depth, 0.01, 1e-15);
    EXPECT_NEAR(overlaps[1].point.z(), -0.005, 1e-15);
    EXPECT_EQ(find_overlaps(w.scene, w.state, 1e-4).size(), 3U);
}

}  // namespace
}  // namespace scree::solvers
