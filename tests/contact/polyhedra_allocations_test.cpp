// The narrow phase of polyhedra allocates nothing once its scratch has met the largest shapes, that of terrain nothing.
#include <gtest/gtest.h>

#include "contact/polyhedra/polyhedron_polyhedron.hpp"
#include "contact/polyhedra/sphere_polyhedron.hpp"
#include "contact/walls/wall_contact.hpp"
#include "tests/testing/count_allocations.hpp"
#include "tests/testing/height_grid.hpp"
#include "tests/testing/hull_shape.hpp"

namespace scree::contact {
namespace {

TEST(PolyhedraAllocations, NothingIsAllocated) {
    Random random(31, 4, 0);
    const ConvexShape rock = testing::rock_shape(30, {0.8, 0.6, 0.5}, random), cube = testing::box_shape({1, 1, 1});
    std::vector<Vec3> room_a(placed_size(rock)), room_b(placed_size(rock));
    PolyhedraScratch scratch;
    Manifold found;
    std::size_t points = 0, before = 0;
    for (int i = 0; i < 4000; ++i) {
        if (i == 2000) before = testing::allocations;  // by then it has met everything
        Random draw(31, 5, static_cast<std::uint64_t>(i % 2000));
        const ConvexShape &sa = i % 3 == 0 ? cube : rock, &sb = i % 2 == 0 ? cube : rock;
        const Placed a =
            place(sa, draw.uniform(0.0, 1.5) * testing::random_direction(draw), testing::random_turn(draw), room_a);
        const Placed b = place(sb, Vec3::Zero(), testing::random_turn(draw), room_b);
        Vec3 axis = Vec3::Zero();
        polyhedron_polyhedron(a, b, 0.05, axis, scratch, found);
        points += static_cast<std::size_t>(found.count);
        sphere_polyhedron(a.position, 0.1, b);
    }
    EXPECT_EQ(testing::allocations - before, 0U);
    EXPECT_GT(points, 1000U);
}

TEST(TerrainAllocations, NothingIsAllocated) {
    const WallShape shape = testing::wall_of(testing::noisy_grid(40, 0.1, 0.4, 8));
    const std::size_t before = testing::allocations;
    int found = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        Random random(45, 1, i);
        const Vec3 x(random.uniform(-2.3, 2.3), random.uniform(-2.3, 2.3), random.uniform(-0.2, 1.0));
        WallContacts contacts;
        find_contacts(shape, x, 0.4, 0.0, contacts);
        found += contacts.count + (may_touch(shape, x, 0.4, 0.1) ? 1 : 0);
    }
    EXPECT_GT(found, 1000);
    EXPECT_EQ(testing::allocations - before, 0U);
}

}  // namespace
}  // namespace scree::contact
