// Impulses carried from step to step by the contacts' keys.
#include "solvers/warm_start.hpp"

#include <gtest/gtest.h>

namespace scree::solvers {
namespace {

contact::Contact contact_of(ContactKey key, const Vec3& normal = Vec3::UnitZ()) {
    return {key, 0, 0, normal, 0.0, 0.5, 0.0};
}
ContactKey key(std::uint64_t a, std::uint64_t b) {
    return ContactKey::bodies(BodyId{a}, BodyId{b});
}

TEST(WarmStart, MatchesByKeyAndScalesWithTheStep) {
    WarmStart last;
    last.step = 0.01;
    last.key = {key(1, 2), key(1, 5), key(3, 4)};
    last.impulse_normal = {1.0, 2.0, 3.0};
    const contact::ContactSet now{contact_of(key(0, 9)), contact_of(key(1, 5)), contact_of(key(2, 3)),
                                  contact_of(key(3, 4)), contact_of(key(8, 9))};
    std::vector<Vec3> impulse;
    std::vector<double> normal(now.size(), 0.0);
    std::vector<std::uint32_t> unmatched;
    match_warm_start(now, last, 0.005, false, impulse, normal, &unmatched);
    EXPECT_EQ(unmatched, (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(normal, (std::vector<double>{0.0, 1.0, 0.0, 1.5, 0.0}));
    EXPECT_TRUE(impulse.empty());
}

TEST(WarmStart, PlacesOfAWallAreToldApart) {
    WarmStart last;
    last.step = 1.0;
    last.key = {ContactKey::wall(BodyId{1}, WallIndex{0}, 1), ContactKey::wall(BodyId{1}, WallIndex{2}, 0)};
    last.impulse_normal = {1.0, 2.0};
    const contact::ContactSet now{contact_of(key(1, 2)), contact_of(ContactKey::wall(BodyId{1}, WallIndex{0}, 0)),
                                  contact_of(ContactKey::wall(BodyId{1}, WallIndex{0}, 1)),
                                  contact_of(ContactKey::wall(BodyId{1}, WallIndex{2}, 0))};
    std::vector<Vec3> impulse;
    std::vector<double> normal(now.size(), 0.0);
    match_warm_start(now, last, 1.0, false, impulse, normal);
    EXPECT_EQ(normal, (std::vector<double>{0.0, 0.0, 1.0, 2.0}));
}

TEST(WarmStart, AVectorThatWouldPullIsDropped) {
    WarmStart last;
    last.step = 1.0;
    last.key = {key(1, 2), key(3, 4)};
    last.impulse_vector = {Vec3(1, 0, 2), Vec3(1, 0, 2)};
    const contact::ContactSet now{contact_of(key(1, 2)), contact_of(key(3, 4), -Vec3::UnitZ())};
    std::vector<Vec3> impulse(now.size(), Vec3::Zero());
    std::vector<double> normal;
    match_warm_start(now, last, 2.0, true, impulse, normal);
    EXPECT_EQ(impulse, (std::vector<Vec3>{Vec3(2, 0, 4), Vec3::Zero()}));
    EXPECT_TRUE(normal.empty());
}

TEST(WarmStart, KeepsWhatIsNotZeroInOrder) {
    const contact::ContactSet contacts{contact_of(key(1, 2)), contact_of(key(1, 3)), contact_of(key(2, 3))};
    WarmStart kept;
    kept.key = {key(7, 8)};
    keep_for_warm_start(contacts, {}, {0.5, 0.0, 0.25}, 0.1, kept);
    EXPECT_EQ(kept.key, (std::vector{key(1, 2), key(2, 3)}));
    EXPECT_EQ(kept.impulse_normal, (std::vector<double>{0.5, 0.25}));
    EXPECT_TRUE(kept.impulse_vector.empty());
    EXPECT_EQ(kept.step, 0.1);
    keep_for_warm_start(contacts, {Vec3::Zero(), Vec3(0, 0, 1), Vec3::Zero()}, {}, 0.2, kept);
    EXPECT_EQ(kept.key, (std::vector{key(1, 3)}));
    EXPECT_EQ(kept.impulse_vector, (std::vector<Vec3>{Vec3(0, 0, 1)}));
    EXPECT_TRUE(kept.impulse_normal.empty());
}

TEST(WarmStart, WhatHasNoImpulseStaysAsItWas) {
    std::vector<Vec3> impulse(1, Vec3::Ones());
    std::vector<double> normal;
    std::vector<std::uint32_t> unmatched;
    match_warm_start({contact_of(key(1, 2))}, WarmStart{}, 1.0, true, impulse, normal, &unmatched);
    EXPECT_EQ(impulse, (std::vector<Vec3>{Vec3::Ones()}));
    EXPECT_TRUE(unmatched.empty());
    WarmStart last;
    last.step = 1.0;
    last.key = {key(0, 1), key(1, 3), key(2, 3)};
    last.impulse_vector.assign(3, Vec3::UnitZ());
    match_warm_start({contact_of(key(1, 2))}, last, 1.0, true, impulse, normal, &unmatched);
    EXPECT_EQ(impulse, (std::vector<Vec3>{Vec3::Ones()}));
    EXPECT_EQ(unmatched, (std::vector<std::uint32_t>{0, 1, 2}));
    unmatched.clear();
    match_warm_start({}, last, 1.0, true, impulse, normal, &unmatched);
    EXPECT_EQ(unmatched.size(), 3U);
}

}  // namespace
}  // namespace scree::solvers
