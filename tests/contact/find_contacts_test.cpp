// The contacts of a step: order, geometry, laws of the pairs, walls that move, appear and go.
#include "contact/find_contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/random.hpp"
#include "tests/testing/small_scene.hpp"

namespace scree::contact {
namespace {

using World = testing::SmallScene;

ContactSet contacts_of(World& w, double begin = 0.0) {
    w.state.time = begin;
    const StepTimes times{begin, w.scene.time.step};
    CandidateList candidates;
    std::vector<double> margin;
    contact_margins(w.scene, w.state, times, margin);
    candidates.update(w.scene, w.state, times.step, margin);
    ContactSet contacts;
    find_contacts(w.scene, w.state, times, candidates, Domain(), contacts);
    return contacts;
}

TEST(FindContacts, InOrderOfKeyEachOnce) {
    World w(1e-3, 0.3);
    Random random(3, 1, 0);
    for (int i = 0; i < 200; ++i) {
        w.state.next_id += random.bits() % 3;  // ids with holes
        w.add(Vec3(random.uniform(), random.uniform(), random.uniform()), random.uniform(0.02, 0.1));
    }
    w.add_wall(BoxWall{Vec3::Zero(), Vec3::Ones(), true, false, false});
    w.add_floor();
    const ContactSet contacts = contacts_of(w);
    ASSERT_GT(contacts.size(), 150U);
    for (std::size_t c = 1; c < contacts.size(); ++c) EXPECT_LT(contacts[c - 1].key, contacts[c].key);
    for (const Contact& c : contacts) {
        EXPECT_EQ(c.key.a, raw(w.state.bodies.id[c.a]));
        if (!c.key.is_wall()) {
            EXPECT_EQ(c.key.b, raw(w.state.bodies.id[c.b]));
            EXPECT_LT(c.a, c.b);
        }
    }
}

TEST(FindContacts, NormalGapAndPointOfAPair) {
    World w(1e-3);
    w.add(Vec3(1, 2, 3), 0.5);
    w.add(Vec3(1, 2, 3) + 0.9 * Vec3(2, -1, 2) / 3, 0.6);
    const ContactSet contacts = contacts_of(w);
    ASSERT_EQ(contacts.size(), 1U);
    const Contact& c = contacts[0];
    EXPECT_NEAR(c.gap, 0.9 - 1.1, 1e-15);
    EXPECT_LT((c.normal + Vec3(2, -1, 2) / 3).norm(), 1e-15);  // from b to a
    EXPECT_LT((c.point(w.position(0), 0.5) - (Vec3(1, 2, 3) + 0.4 * Vec3(2, -1, 2) / 3)).norm(), 1e-15);
}

TEST(FindContacts, TheLawOfEachPairOfMaterials) {
    World w(1e-3);
    w.scene.materials = {{"a", 1000.0}, {"b", 1000.0}};
    w.scene.pairs = PairTable(2);
    const MaterialIndex a{0}, b{1};
    w.scene.pairs.set(a, a, {0.1, 0.0});
    w.scene.pairs.set(a, b, {0.2, 0.5});
    w.scene.pairs.set(b, b, {0.3, 1.0});
    w.add(Vec3(0, 0, 0.99), 1.0, Vec3(0, 0, -2));
    w.add(Vec3(0, 1.99, 0.99), 1.0, Vec3(0, 0, -2));
    w.state.bodies.material[1] = b;
    w.add_floor();
    w.scene.walls[0].material = b;
    const ContactSet contacts = contacts_of(w);
    ASSERT_EQ(contacts.size(), 3U);  // 0 with 1, 0 with the floor, 1 with the floor
    EXPECT_EQ(contacts[0].friction, 0.2);
    EXPECT_EQ(contacts[0].bias, 0.0);
    EXPECT_EQ(contacts[1].friction, 0.2);
    EXPECT_EQ(contacts[1].bias, -1.0);
    EXPECT_EQ(contacts[2].friction, 0.3);
    EXPECT_EQ(contacts[2].bias, -2.0);
}

TEST(FindContacts, CoincidentCentresHaveANormal) {
    World w(1e-3);
    w.add(Vec3(1, 1, 1), 0.5);
    w.add(Vec3(1, 1, 1), 0.5);
    w.add(Vec3(-5, 1, 1), 0.5, Vec3(3, 4, 0));
    w.add(Vec3(-5, 1, 1), 0.5);
    const ContactSet contacts = contacts_of(w);
    ASSERT_EQ(contacts.size(), 2U);
    EXPECT_EQ(contacts[0].normal, Vec3::UnitZ());
    EXPECT_EQ(contacts[0].gap, -1.0);
    EXPECT_LT((contacts[1].normal - Vec3(-0.6, -0.8, 0)).norm(), 1e-15);  // back to where it came from
}

TEST(FindContacts, WallsThatAreNotThereDoNotTouch) {
    World w(0.1);
    w.add(Vec3(0, 0, 0.9), 1.0);
    w.add_floor();
    w.scene.walls[0].appears = 1.0;
    w.scene.walls[0].goes = 2.0;
    EXPECT_TRUE(contacts_of(w, 0.9).empty());  // the middle of the step decides: 0.95
    EXPECT_FALSE(contacts_of(w, 0.96).empty());
    EXPECT_FALSE(contacts_of(w, 1.94).empty());
    EXPECT_TRUE(contacts_of(w, 1.96).empty());
}

TEST(FindContacts, AMovingWallIsWhereItIsAtTheMiddleOfTheStep) {
    World w(0.1);
    w.gravity(Vec3::Zero());
    WallMotion turn;  // the floor turns upright about y in 1 s
    turn.axis = Vec3::UnitY();
    turn.rate = 0.5 * std::numbers::pi;
    w.add(Vec3(0.9, 0, 5), 1.0);
    w.add_wall(PlaneWall{Vec3::Zero(), Vec3::UnitZ()}, turn);
    const ContactSet contacts = contacts_of(w, 0.95);
    ASSERT_EQ(contacts.size(), 1U);
    EXPECT_LT((contacts[0].normal - Vec3::UnitX()).norm(), 1e-15);
    EXPECT_NEAR(contacts[0].gap, -0.1, 1e-14);
    // the wall's surface at height 5 comes with rate x arm: u_N^- = -5 pi / 2, and e = 0 gives no bias
    EXPECT_EQ(contacts[0].bias, 0.0);
}

}  // namespace
}  // namespace scree::contact
