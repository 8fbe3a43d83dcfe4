// The narrow phase of polyhedra allocates nothing once its scratch has met the largest shapes.
// This file counts every allocation of the test program by replacing the global operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "contact/polyhedra/polyhedron_polyhedron.hpp"
#include "contact/polyhedra/sphere_polyhedron.hpp"
#include "tests/testing/hull_shape.hpp"

namespace {

std::atomic<std::size_t> allocations{0};

void* allocate(std::size_t size, std::size_t align) {
    ++allocations;
    void* p = nullptr;
    if (posix_memalign(&p, align, size == 0 ? 1 : size) != 0) throw std::bad_alloc();
    return p;
}

}  // namespace

void* operator new(std::size_t size) {
    return allocate(size, alignof(std::max_align_t));
}
void* operator new[](std::size_t size) {
    return allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t align) {
    return allocate(size, static_cast<std::size_t>(align));
}
void operator delete(void* p) noexcept {
    std::free(p);
}
void operator delete[](void* p) noexcept {
    std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
    std::free(p);
}
void operator delete[](void* p, std::size_t) noexcept {
    std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
    std::free(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
    std::free(p);
}

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
        if (i == 2000) before = allocations;  // by then it has met everything
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
    EXPECT_EQ(allocations - before, 0U);
    EXPECT_GT(points, 1000U);
}

}  // namespace
}  // namespace scree::contact
