// The order of work: what blocks and batches promise to the kernels.
#include "solvers/layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "core/random.hpp"
#include "tests/testing/solver_case.hpp"

namespace scree::solvers {
namespace {

using testing::SmallScene;

void fill(SmallScene& w, int count, double least, double most, const Vec3& centre, std::uint64_t seed) {
    Random random(seed, 1, 0);
    for (int i = 0; i < count; ++i)
        w.add(centre + Vec3(random.uniform(), random.uniform(), random.uniform()),
              least * std::pow(most / least, random.uniform()));
    w.add_wall(BoxWall{centre, centre + Vec3::Ones(), true, false, false});
}

// Moving bodies of a contact.
std::vector<std::uint32_t> bodies_of(const contact::Contact& c) {
    return c.key.is_wall() ? std::vector{c.a} : std::vector{c.a, c.b};
}

int colour_of(const contact::Contact& c, const Bodies& bodies, double size) {
    const BlockIndex at = contact::home_of(c, bodies, size).block;
    return (at[0] & 1) + 2 * (at[1] & 1) + 4 * (at[2] & 1);
}

void expect_sound(const Layout& layout, const contact::ContactSet& contacts, const Bodies& bodies, double size) {
    std::vector<int> seen(contacts.size(), 0);
    std::map<int, std::map<std::uint32_t, std::size_t>> block_of;  // colour, body: block
    std::uint32_t next = 0;
    for (std::size_t k = 0; k < layout.blocks().size(); ++k) {
        const Block& block = layout.blocks()[k];
        ASSERT_EQ(block.begin, next);  // blocks follow one another and are not empty
        ASSERT_LT(block.begin, block.end);
        next = block.end;
        for (std::uint32_t b = block.begin; b < block.end; ++b) {
            std::set<std::uint32_t> in_batch;
            for (const std::uint32_t c : layout.lanes()[b]) {
                if (c == kNoContact) continue;
                ++seen[c];
                const contact::Contact& contact = contacts[c];
                double widest = 0.0;
                for (const std::uint32_t body : bodies_of(contact)) {
                    EXPECT_TRUE(in_batch.insert(body).second) << "two lanes of a batch share body " << body;
                    widest = std::max(widest, 2.0 * bodies.radius[body]);
                }
                if (widest + std::max(contact.gap, 0.0) >= size) {  // a wide body's contacts make up the last block
                    EXPECT_EQ(k + 1, layout.blocks().size());
                    continue;
                }
                for (const std::uint32_t body : bodies_of(contact)) {
                    const auto [at, first] = block_of[colour_of(contact, bodies, size)].emplace(body, k);
                    EXPECT_EQ(at->second, k) << "two blocks of one colour share body " << body;
                }
            }
            EXPECT_FALSE(in_batch.empty());
        }
    }
    EXPECT_EQ(next, layout.batches());
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
}

TEST(Layout, EachContactOnceAndNoConflicts) {
    struct Case {
        double least, most;
        Vec3 centre;
    };
    std::uint64_t seed = 0;
    for (const Case& c : {Case{0.03, 0.03, Vec3::Zero()},
                          {0.01, 0.1, Vec3(-0.5, -0.5, -0.5)},
                          {0.005, 0.4, Vec3(0, 0, 0)},
                          {0.02, 0.04, Vec3(-1e4, 1e4, 0)}}) {
        SmallScene w(1e-3);
        fill(w, 800, c.least, c.most, c.centre, ++seed);
        const contact::ContactSet contacts = testing::contacts_of(w);
        ASSERT_GT(contacts.size(), 300U);
        Layout layout;
        const double size = choose_block_size(w.state.bodies);
        layout.arrange(contacts, w.state.bodies, size);
        expect_sound(layout, contacts, w.state.bodies, size);
        layout.arrange(contacts, w.state.bodies, size);  // again: nothing of the last time stays
        expect_sound(layout, contacts, w.state.bodies, size);
        layout.arrange(contacts, w.state.bodies, 100.0);  // all in one block, or in eight
        expect_sound(layout, contacts, w.state.bodies, 100.0);
        layout.arrange(contacts, w.state.bodies, 2.5 * c.least);  // nearly all too wide for a block
        expect_sound(layout, contacts, w.state.bodies, 2.5 * c.least);
    }
}

// A body that touches 300 others fills 300 batches: more than the 64 that first fit looks at.
TEST(Layout, ABodyWithVeryManyContacts) {
    SmallScene w(1e-3);
    w.add(Vec3::Zero(), 1.0);
    Random random(3, 1, 0);
    for (int i = 0; i < 300; ++i) {
        const Vec3 n = Vec3(random.normal(), random.normal(), random.normal()).normalized();
        w.add(1.0499 * n, 0.05);
    }
    const contact::ContactSet contacts = testing::contacts_of(w);
    ASSERT_GE(contacts.size(), 300U);
    for (const double size : {choose_block_size(w.state.bodies), 10.0}) {
        Layout layout;
        layout.arrange(contacts, w.state.bodies, size);
        expect_sound(layout, contacts, w.state.bodies, size);
        EXPECT_GE(layout.batches(), 300U);
    }
}

// The order is one of positions and ids: where a body lies in the arrays does not count.
TEST(Layout, DoesNotDependOnPlacesInTheArrays) {
    SmallScene w(1e-3);
    fill(w, 500, 0.02, 0.08, Vec3::Zero(), 9);
    const contact::ContactSet contacts = testing::contacts_of(w);
    const Bodies& bodies = w.state.bodies;
    std::vector<std::uint32_t> place(bodies.size());  // of each body, in the other arrays
    std::iota(place.begin(), place.end(), 0U);
    Random random(4, 1, 0);
    for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[random.bits() % i]);
    Bodies other = bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        other.position[place[i]] = bodies.position[i];
        other.radius[place[i]] = bodies.radius[i];
        other.id[place[i]] = bodies.id[i];
    }
    contact::ContactSet moved = contacts;
    for (contact::Contact& c : moved) {
        c.a = place[c.a];
        if (!c.key.is_wall()) c.b = place[c.b];
    }
    Layout layout, other_layout;
    layout.arrange(contacts, bodies, 0.4);
    other_layout.arrange(moved, other, 0.4);
    EXPECT_EQ(layout.lanes(), other_layout.lanes());
}

TEST(Layout, NoContactsNoBatches) {
    SmallScene w(1e-3);
    w.add(Vec3::Zero(), 1.0);
    Layout layout;
    layout.arrange({}, w.state.bodies, 1.0);
    EXPECT_TRUE(layout.blocks().empty());
    EXPECT_EQ(layout.batches(), 0U);
}

TEST(Layout, BatchesOfADensePackAreNearlyFull) {
    SmallScene w(1e-3);
    fill(w, 3000, 0.04, 0.05, Vec3::Zero(), 12);
    const contact::ContactSet contacts = testing::contacts_of(w);
    Layout layout;
    layout.arrange(contacts, w.state.bodies, choose_block_size(w.state.bodies));
    EXPECT_GT(static_cast<double>(contacts.size()), 0.8 * kLanes * static_cast<double>(layout.batches()));
}

TEST(Layout, BlockSizeFitsTheBodies) {
    const auto choose = [](const std::vector<double>& radius) {
        SmallScene w(1e-3);
        for (const double r : radius) w.add(Vec3::Zero(), r);
        return choose_block_size(w.state.bodies);
    };
    EXPECT_EQ(choose({}), 0.0);
    EXPECT_GE(choose({0.5, 0.5, 0.5}), 2.2);  // no body is too wide
    EXPECT_GE(choose({1.0, 1.0, 3.0}), 6.6);
    std::vector<double> many(1000, 0.01);
    many.push_back(1.0);
    EXPECT_LT(choose(many), 0.5);  // one boulder does not make the blocks of all
}

}  // namespace
}  // namespace scree::solvers
