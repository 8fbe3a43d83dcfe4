// Errors that all ranks have or only some; overlaps of bodies that lie on different ranks.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/error_agreement.hpp"
#include "app/overlaps.hpp"
#include "core/random.hpp"
#include "tests/mpi/dealt.hpp"

namespace scree::app {
namespace {

TEST(ErrorAgreement, WhatAllHaveIsSaidOnce) {
    const Communicator ranks = Communicator::world();
    ErrorAgreement errors(ranks);
    for (int again = 0; again < 2; ++again) {
        ASSERT_TRUE(errors.everywhere());
        const ErrorAgreement::Ending same = errors.agree("disk full", 4);
        EXPECT_EQ(same.code, 4);
        EXPECT_EQ(same.shown, ranks.root());
    }
    ASSERT_TRUE(errors.everywhere());
    const bool last = ranks.rank() + 1 == ranks.size();
    const ErrorAgreement::Ending ending = errors.agree(last ? "something else" : "disk full", last ? 70 : 4);
    EXPECT_EQ(ending.code, 70);
    EXPECT_EQ(ending.shown, ranks.root() || last);
}

TEST(ErrorAgreement, WhatOneHasIsNotEverywhere) {
    const Communicator ranks = Communicator::world();
    if (ranks.alone()) GTEST_SKIP() << "needs two ranks";
    ErrorAgreement errors(ranks);
    if (ranks.rank() == 1) {
        EXPECT_FALSE(errors.everywhere());  // the others are at the barrier below
        EXPECT_FALSE(errors.everywhere());
    }
    ranks.barrier();
    EXPECT_EQ(errors.everywhere(), ranks.rank() != 1);  // the others, late, see that rank 1 had asked
}

TEST(AtRoot, OneWorksAndAllThrow) {
    const Communicator ranks = Communicator::world();
    int worked = 0;
    at_root(ranks, [&] { ++worked; });
    EXPECT_EQ(worked, ranks.root() ? 1 : 0);
    try {
        at_root(ranks, [] { throw ScenarioError("a.yaml:1:1: error: nothing is right"); });
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_scenario);
        EXPECT_STREQ(error.what(), "a.yaml:1:1: error: nothing is right");
    }
}

// Bodies of sizes 1 : 40 at random places, most of them overlapping something.
State scattered(std::uint64_t seed, int count, double side) {
    State state;
    for (int k = 0; k < count; ++k) {
        Random random(seed, 0, static_cast<std::uint64_t>(k));
        Vec3 x;
        for (int axis = 0; axis < 3; ++axis) x[axis] = random.uniform(-side, side);
        state.bodies.id.push_back(BodyId{static_cast<std::uint64_t>(3 * k)});
        state.bodies.position.push_back(x);
        state.bodies.velocity.push_back(Vec3::Zero());
        state.bodies.mass.push_back(1.0);
        state.bodies.material.push_back(MaterialIndex{0});
        state.bodies.radius.push_back(random.uniform() < 0.05 ? 0.4 : random.uniform(0.01, 0.05));
    }
    return state;
}

TEST(Overlaps, CountedOnceHoweverBodiesLieOnRanks) {
    const Communicator ranks = Communicator::world();
    Scene scene;
    Wall floor;
    floor.shape = PlaneWall{Vec3(0, 0, -0.5), Vec3::UnitZ()};
    scene.walls.push_back(floor);
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const State whole = scattered(seed, seed == 0 ? 0 : static_cast<int>(20 * seed), seed % 3 == 0 ? 0.5 : 2.0);
        const Overlaps expected = count_overlaps(scene, whole, 0.01, Communicator::self());
        State mine;
        mine.bodies = testing::share(whole.bodies, seed, testing::Ghosts::none);
        const Overlaps found = count_overlaps(scene, mine, 0.01, ranks);
        EXPECT_EQ(expected.count, found.count) << "seed " << seed;
        EXPECT_TRUE(seed < 4 || expected.count > 0);
        if (!ranks.root()) continue;
        ASSERT_EQ(expected.deepest.has_value(), found.deepest.has_value()) << "seed " << seed;
        if (!expected.deepest) continue;
        EXPECT_EQ(expected.deepest->key.a, found.deepest->key.a) << "seed " << seed;
        EXPECT_EQ(expected.deepest->key.b, found.deepest->key.b) << "seed " << seed;
        EXPECT_EQ(expected.deepest->depth, found.deepest->depth) << "seed " << seed;
        EXPECT_EQ(expected.deepest->point, found.deepest->point) << "seed " << seed;
    }
}

}  // namespace
}  // namespace scree::app
