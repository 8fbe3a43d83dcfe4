// A kept list must give the contacts that a list made anew in each step gives: it leaves no trace in results.
#include "contact/candidate_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

// A few bodies at once jump to one place, leave or arrive there, so that those looked at since the last list of all
// meet each other; indices change, and ids tell who is who. All pairs within the margins must be there.
TEST(CandidateList, BodiesThatComeAndGo) {
    World w(1e-3, 0.0, 0.5);
    for (std::uint64_t k = 0; k < 5; ++k) fill(w, 0.1, 20 + k);
    Random random(9, 1, 0);
    Bodies& b = w.state.bodies;
    const auto any = [&] { return static_cast<std::size_t>(random.uniform() * static_cast<double>(b.size())); };
    CandidateList kept;
    std::size_t meetings = 0;
    for (int round = 0; round < 300; ++round) {
        const Vec3 place(random.uniform(), random.uniform(), 0.25 * (round % 4) + 2.0);
        for (int k = round % 3; k > 0; --k) b.position[any()] = place + 0.01 * k * Vec3::Ones();
        if (round % 5 == 0) {
            const auto gone = static_cast<std::ptrdiff_t>(any());
            b.id.erase(b.id.begin() + gone);
            b.radius.erase(b.radius.begin() + gone);
            b.mass.erase(b.mass.begin() + gone);
            b.material.erase(b.material.begin() + gone);
            b.position.erase(b.position.begin() + gone);
            b.velocity.erase(b.velocity.begin() + gone);
            w.add(place, random.uniform(0.01, 0.08));
            kept.invalidate();
        }
        std::vector<double> margin;
        contact_margins(w.scene, w.state, {w.state.time, 1e-3}, margin);
        kept.update(w.scene, w.state, 1e-3, margin);
        std::size_t missing = 0;
        for (std::size_t i = 0; i < b.size(); ++i)
            for (std::size_t j = i + 1; j < b.size(); ++j) {
                const double reach = b.radius[i] + b.radius[j] + margin[i] + margin[j];
                if ((b.position[i] - b.position[j]).norm() > reach) continue;
                meetings += b.position[i].z() > 1.5 ? 1 : 0;
                const auto partners = kept.partners(i);
                missing += std::binary_search(partners.begin(), partners.end(), j) ? 0 : 1;
            }
        EXPECT_EQ(missing, 0U) << "round " << round;
    }
    EXPECT_GT(meetings, 1000U);
    EXPECT_LT(kept.rebuilds(), 100U) << "a few bodies are no reason for a new list of all";
}

// What update() promises: if it returns false, nothing was added.
TEST(CandidateList, TellsWhenPairsOrWallsWereAdded) {
    World w(1e-3, 0.0, 0.5);
    fill(w, 1.0, 10);
    w.add_floor();
    CandidateList kept;
    std::vector<double> margin;
    const auto entries = [&] {
        std::vector<std::pair<std::size_t, std::uint32_t>> all;
        for (std::size_t i = 0; i < w.state.bodies.size(); ++i) {
            for (const std::uint32_t j : kept.partners(i)) all.emplace_back(i, j);
            for (const std::uint32_t wall : kept.walls(i)) all.emplace_back(i, 1000 + wall);
        }
        return all;
    };
    std::vector<std::pair<std::size_t, std::uint32_t>> before;
    int added = 0, same = 0;
    for (int k = 0; k < 200; ++k) {
        const StepTimes times{w.state.time, 1e-3};
        contact_margins(w.scene, w.state, times, margin);
        const bool more = kept.update(w.scene, w.state, times.step, margin);
        auto now = entries();
        std::sort(now.begin(), now.end());
        EXPECT_EQ(std::adjacent_find(now.begin(), now.end()), now.end()) << "twice in the list";
        EXPECT_TRUE(more || std::includes(before.begin(), before.end(), now.begin(), now.end()));
        (more ? added : same) += 1;
        before = now;
        Bodies& b = w.state.bodies;
        for (std::size_t i = 0; i < b.size(); ++i) b.position[i] += times.step * b.velocity[i];
        w.state.time += times.step;
    }
    EXPECT_GT(added, 10);
    EXPECT_GT(same, 10);
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
