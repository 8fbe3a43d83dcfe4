// A kept list must give the contacts that a list made anew in each step gives: it leaves no trace in results.
#include "contact/candidate_list.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "contact/find_contacts.hpp"
#include "core/random.hpp"
#include "tests/testing/small_scene.hpp"

namespace scree::contact {
namespace {

using World = testing::SmallScene;

ContactSet contacts_with(const World& w, const StepTimes& times, CandidateList& list) {
    std::vector<double> margin;
    contact_margins(w.scene, w.state, times, margin);
    list.update(w.scene, w.state, times.step, margin);
    ContactSet contacts;
    find_contacts(w.scene, w.state, times, list, Domain(), contacts);
    return contacts;
}

bool same(const ContactSet& a, const ContactSet& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Contact& x, const Contact& y) {
        return x.key == y.key && x.gap == y.gap && x.normal == y.normal && x.bias == y.bias;
    });
}

// Moves the bodies by `steps` steps of `h`; compares the contacts of every step. Returns how many there were.
std::size_t compare(World& w, CandidateList& kept, int steps, double h) {
    std::size_t seen = 0;
    for (int k = 0; k < steps; ++k) {
        Bodies& b = w.state.bodies;
        for (std::size_t i = 0; i < b.size(); ++i) b.position[i] += 0.5 * h * b.velocity[i];
        const StepTimes times{w.state.time, h};
        CandidateList fresh;
        const ContactSet expected = contacts_with(w, times, fresh);
        EXPECT_TRUE(same(contacts_with(w, times, kept), expected)) << "step " << k;
        seen += expected.size();
        for (std::size_t i = 0; i < b.size(); ++i) b.position[i] += 0.5 * h * b.velocity[i];
        w.state.time += h;
    }
    return seen;
}

void fill(World& w, double speed, std::uint64_t seed) {
    Random random(seed, 1, 0);
    for (int i = 0; i < 150; ++i) {
        const double share = random.uniform();  // a few fast, many slow
        const Vec3 v(random.normal(), random.normal(), random.normal());
        w.add(Vec3(random.uniform(), random.uniform(), random.uniform()), random.uniform(0.01, 0.08),
              speed * share * share * share * v);
    }
}

TEST(CandidateList, KeptListGivesTheContactsOfAFreshOne) {
    for (const double speed : {0.1, 1.0, 10.0}) {
        World w(1e-3, 0.0, 0.5);
        fill(w, speed, 4);
        w.add_floor();
        w.add_wall(BoxWall{Vec3::Zero(), Vec3::Ones(), true, false, false});
        CandidateList kept;
        EXPECT_GT(compare(w, kept, 60, 1e-3), 1000U);
        if (speed > 1.0) continue;  // so fast that a new list may be the cheaper one
        EXPECT_LT(kept.rebuilds(), 60U) << "made anew in each step: it saves nothing";
    }
}

TEST(CandidateList, SlowBodiesKeepTheirList) {
    World w(1e-3);
    fill(w, 0.0, 5);
    CandidateList kept;
    compare(w, kept, 30, 1e-3);
    EXPECT_EQ(kept.rebuilds(), 1U);
}

TEST(CandidateList, BodiesThatSpeedUp) {
    World w(1e-3, 0.0, 0.5);
    fill(w, 0.01, 6);
    CandidateList kept;
    for (int round = 0; round < 12; ++round) {
        for (Vec3& v : w.state.bodies.velocity) v *= 2.0;
        compare(w, kept, 4, 1e-3);
    }
}

TEST(CandidateList, MovingWalls) {
    World w(1e-3, 0.0, 0.5);
    fill(w, 0.3, 7);
    WallMotion shake;
    shake.amplitude = Vec3(0, 0, 0.2);
    shake.frequency = 7.0;
    w.add_wall(PlaneWall{Vec3(0, 0, 0.1), Vec3::UnitZ()}, shake);
    WallMotion turn;
    turn.centre = Vec3(0.5, 0.5, 0.5);
    turn.axis = Vec3(1, 2, 2) / 3;
    turn.rate = 5.0;
    w.add_wall(BoxWall{Vec3::Constant(-0.1), Vec3::Constant(1.1), true, false, false}, turn);
    WallMotion roll = turn;  // turns and travels
    roll.velocity = Vec3(0, 30, 0);
    w.add_wall(DiscWall{Vec3(0.5, 0.5, 0.5), Vec3::UnitZ(), 3.0}, roll);
    CandidateList kept;
    EXPECT_GT(compare(w, kept, 100, 1e-3), 1000U);
}

TEST(CandidateList, StepsOfChangingLength) {
    World w(1e-3, 0.0, 0.5);
    w.gravity(Vec3::Zero());
    for (int i = 0; i < 40; ++i) w.add(Vec3(i, 0, 0.05 + 0.0005 * i), 0.05);
    WallMotion push;
    push.velocity = Vec3(0, 0, 2.0);
    w.add_wall(PlaneWall{Vec3::Zero(), Vec3::UnitZ()}, push);
    CandidateList kept;
    for (const double h : {1e-3 / 256, 8e-3, 1e-3 / 64, 1e-3}) compare(w, kept, 5, h);
}

// A wall that turns about a centre which travels far from where the motion began: the arm counts, not the distance
// from the first centre.
TEST(CandidateList, AWallThatTurnsAndTravels) {
    World w(1e-3, 0.0, 0.5);
    w.gravity(Vec3::Zero());
    for (int i = 0; i < 40; ++i) w.add(Vec3(0, 0.003 * i, 0), 0.001);
    WallMotion roll;
    roll.axis = Vec3::UnitX();
    roll.rate = 1.0;
    roll.velocity = Vec3(0, 10, 0);
    w.add_wall(PlaneWall{Vec3(0, 0, -1000.6), Vec3::UnitZ()}, roll);
    w.state.time = 10.0;
    w.scene.walls[0].motion.start = 0.0;
    // at 10 s the plane has turned by 10 rad about (0, 100, 0): put it so that it just misses the bodies then
    const WallPose pose = pose_at(roll, 10.0);
    auto& plane = std::get<PlaneWall>(w.scene.walls[0].shape);
    const Vec3 normal = pose.rotation * plane.normal;
    double nearest = 1e300;
    for (const Vec3& x : w.state.bodies.position) nearest = std::min(nearest, normal.dot(x));
    plane.point = pose.to_local(normal * (nearest - 0.004));
    CandidateList kept;
    compare(w, kept, 30, 1e-4);
}

}  // namespace
}  // namespace scree::contact
