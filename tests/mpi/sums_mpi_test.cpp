// Sums, inlets, outlets and overlaps on ranks: bodies dealt out anyhow, ghosts among them, give the bits of one rank
// that has them all.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "solvers/energy.hpp"
#include "solvers/find_overlaps.hpp"
#include "solvers/flows.hpp"
#include "tests/mpi/dealt.hpp"

namespace scree::solvers {
namespace {

using testing::cloud;
using testing::Ghosts;
using testing::owner;
using testing::same;
using testing::share;
using testing::SmallScene;
using testing::world;

TEST(SumsOnRanks, MomentumAndEnergies) {
    for (const int count : {0, 1, 3, 2000})
        for (const std::uint64_t deal : {0, 1, 2}) {
            const Bodies all = cloud(count, 3).state.bodies;
            const Bodies part = share(all, deal, deal == 0 ? Ghosts::none : Ghosts::some);
            const Momentum a = momentum_of(all), b = momentum_of(part, world());
            EXPECT_TRUE(same(a.sum, b.sum));
            EXPECT_EQ(a.size, b.size);
            EXPECT_EQ(a.mass, b.mass);
            EXPECT_EQ(kinetic_energy(all), kinetic_energy(part, world()));
            EXPECT_EQ(potential_energy(all, Vec3(1, 2, 3)), potential_energy(part, Vec3(1, 2, 3), world()));
            EXPECT_TRUE(same(weighted_position(all), weighted_position(part, world())));
        }
}

TEST(SumsOnRanks, OneRanksInfinityReachesAll) {
    Bodies all = cloud(100, 4).state.bodies;
    all.velocity[17].y() = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(std::isfinite(momentum_of(share(all, 0, Ghosts::none), world()).size));
}

// Two inlets over the same crowded room, so that most places are taken and later bodies meet earlier ones.
TEST(FlowsOnRanks, InletsMakeTheBodiesOfOneRank) {
    SmallScene w(1.0, 0.3);
    for (const double diameter : {0.2, 0.3}) {
        Inlet inlet;
        inlet.region = {Vec3(0, 0, 0), Vec3(1, 1, 1)};
        inlet.size = UniformSize{0.8 * diameter, diameter};
        inlet.mass_rate = 300.0;
        inlet.velocity = Vec3(0, 0, -0.25);
        w.scene.inlets.push_back(inlet);
    }
    w.add_floor();
    w.add(Vec3(0.5, 0.5, 0.5), 0.2);
    w.state.bodies.spin = w.given_spins;
    w.state.inlets.resize(2);
    const Plan plan = make_plan(w.scene, w.state.bodies);
    State mine = w.state;
    for (std::uint64_t step = 1; step < 6; ++step) {
        w.state.time = mine.time = static_cast<double>(step);
        mine.bodies = share(w.state.bodies, step, step % 2 == 0 ? Ghosts::some : Ghosts::none);
        const std::size_t before = mine.bodies.size(), all_before = w.state.bodies.size();
        const bool came = make_bodies(w.scene, plan, w.state);
        EXPECT_EQ(make_bodies(w.scene, plan, mine, world()), came);
        EXPECT_TRUE(came);
        const Bodies &a = w.state.bodies, &b = mine.bodies;
        ASSERT_EQ(b.size() - before, world().root() ? a.size() - all_before : 0);
        EXPECT_EQ(b.spin.size(), b.size());
        for (std::size_t k = 0; k < b.size() - before; ++k) {
            EXPECT_EQ(a.id[all_before + k], b.id[before + k]);
            EXPECT_EQ(a.radius[all_before + k], b.radius[before + k]);
            EXPECT_EQ(a.mass[all_before + k], b.mass[before + k]);
            EXPECT_TRUE(same(a.position[all_before + k], b.position[before + k]));
            EXPECT_FALSE(b.is_ghost(before + k));
        }
        EXPECT_EQ(w.state.next_id, mine.next_id);
        EXPECT_EQ(w.state.ledger[Work::inlets], mine.ledger[Work::inlets]);
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_EQ(w.state.inlets[k].attempts, mine.inlets[k].attempts);
            EXPECT_EQ(w.state.inlets[k].bodies, mine.inlets[k].bodies);
            EXPECT_EQ(w.state.inlets[k].mass, mine.inlets[k].mass);
        }
        for (Vec3& x : w.state.bodies.position) x.z() -= 0.3;
    }
    EXPECT_GT(w.state.inlets[1].attempts, 200U);  // a whole step's places were in vain at least once
}

TEST(FlowsOnRanks, OutletsTakeGhostsToo) {
    SmallScene w = cloud(300, 6);
    w.scene.outlets.push_back({"left", HalfSpaceRegion{Vec3::Zero(), Vec3::UnitX()}, 0.0, kForever});
    w.scene.outlets.push_back({"below", HalfSpaceRegion{Vec3::Zero(), Vec3::UnitZ()}, 0.0, kForever});
    w.state.outlets.resize(2);
    State mine = w.state;
    mine.bodies = share(w.state.bodies, 3, Ghosts::some);
    EXPECT_TRUE(take_bodies(w.scene, w.state));
    EXPECT_TRUE(take_bodies(w.scene, mine, world()));
    const Bodies left = share(w.state.bodies, 3, Ghosts::some);
    EXPECT_EQ(mine.bodies.id, left.id);
    EXPECT_EQ(mine.bodies.owned(), left.owned());
    for (std::size_t o = 0; o < 2; ++o) {
        EXPECT_EQ(w.state.outlets[o].bodies, mine.outlets[o].bodies);
        EXPECT_EQ(w.state.outlets[o].mass, mine.outlets[o].mass);
    }
    EXPECT_EQ(w.state.ledger[Work::outlets], mine.ledger[Work::outlets]);
    EXPECT_FALSE(take_bodies(w.scene, mine, world()));
}

TEST(OverlapsOnRanks, EachIsFoundOnce) {
    SmallScene w = cloud(300, 7);
    w.add_floor();
    const std::vector<Overlap> all = find_overlaps(w.scene, w.state, 0.0);
    ASSERT_GT(all.size(), 20U);
    State mine = w.state;
    mine.bodies = share(w.state.bodies, 2, Ghosts::none);
    const std::vector<Overlap> part = find_overlaps(w.scene, mine, 0.0, world());
    EXPECT_EQ(world().sum(static_cast<std::uint64_t>(part.size())), all.size());
    for (const Overlap& overlap : part) {
        EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Overlap& o) {
            return o.key == overlap.key && o.depth == overlap.depth && same(o.point, overlap.point);
        }));
    }
}

}  // namespace
}  // namespace scree::solvers
