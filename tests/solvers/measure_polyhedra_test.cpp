// How far polyhedra reach, and which part of them lies in a region: closed forms, and parts that make the whole.
#include "solvers/measure_polyhedra.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/make_shape.hpp"
#include "core/random.hpp"
#include "tests/testing/some_rotation.hpp"

namespace scree::solvers::detail {
namespace {

PlacedShape tetrahedron() {
    return make_shape({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
}
PlacedShape cube(double edge) {
    Polyhedron body;
    for (int i = 0; i < 8; ++i) body.vertex.push_back(edge * Vec3(i & 1, i >> 1 & 1, i >> 2 & 1));
    body.face = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    return make_shape(body);
}

State state_of(const PlacedShape& placed, const Vec3& position, const Quat& turn) {
    State state;
    state.shapes = {placed.shape};
    state.bodies.id = {BodyId{0}};
    state.bodies.shape = {ShapeIndex{0}};
    state.bodies.radius = {placed.shape.radius};
    state.bodies.mass = {2.0};
    state.bodies.material = {MaterialIndex{0}};
    state.bodies.position = {position};
    state.bodies.orientation = {(turn * placed.rotation).normalized()};
    return state;
}
// Where it was given.
State in_place(const PlacedShape& placed) {
    return state_of(placed, placed.centre, Quat::Identity());
}

const Region kBelow = HalfSpaceRegion{Vec3(0, 0, 0.25), Vec3::UnitZ()};

TEST(MeasurePolyhedra, ATetrahedronBelowAPlane) {
    const State state = in_place(tetrahedron());
    for (const double z : {-1.0, 0.0, 0.1, 0.25, 0.7, 1.0, 2.0}) {
        const double above = std::pow(1.0 - std::clamp(z, 0.0, 1.0), 3);
        const Region below = HalfSpaceRegion{Vec3(5, 7, z), Vec3::UnitZ()};
        EXPECT_NEAR(part_in(below, state, 0), (1.0 - above) / 6.0, 1e-15) << z;
        EXPECT_NEAR(part_between(state, 0, -Vec3::UnitZ(), -9.0, -z), above / 6.0, 1e-15) << z;
    }
    // x + y + z <= 1/2 is a tetrahedron of half the size
    const Region corner = HalfSpaceRegion{Vec3(0.5, 0, 0), Vec3(1, 1, 1).normalized()};
    EXPECT_NEAR(part_in(corner, state, 0), 1.0 / 48.0, 1e-15);
    EXPECT_NEAR(volume_of(state, 0), 1.0 / 6.0, 1e-15);
}

TEST(MeasurePolyhedra, ATurnedCubeInABox) {
    // It stands on an edge: what is lower than s above that edge is a prism of section s^2.
    const double half = std::numbers::sqrt2 / 2.0;
    const State state =
        state_of(cube(1.0), Vec3(1, 2, 3), Quat(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY())));
    const auto box = [](const Vec3& lower, const Vec3& upper) { return Region(BoxRegion{lower, upper}); };
    EXPECT_NEAR(part_in(box({-9, -9, -9}, {9, 9, 9}), state, 0), 1.0, 1e-15);
    EXPECT_NEAR(part_in(box({-9, -9, -9}, {9, 9, 3 - half + 0.2}), state, 0), 0.2 * 0.2, 1e-15);
    EXPECT_NEAR(part_in(box({1, 2, 3}, {9, 9, 9}), state, 0), 1.0 / 8.0, 1e-15);
    EXPECT_NEAR(part_in(box({0.9, 1.9, 2.9}, {1.1, 2.1, 3.1}), state, 0), 0.008, 1e-15);
    EXPECT_EQ(part_in(box({2, 2, 3}, {9, 9, 9}), state, 0), 0.0);
    EXPECT_EQ(part_in(box({1 + half - 0.1, 0, 3.2}, {9, 9, 9}), state, 0), 0.0);  // beside the edge
    const Reach reach = reach_of(state, 0, Vec3::UnitZ());
    EXPECT_NEAR(reach.low, 3.0 - half, 1e-15);
    EXPECT_NEAR(reach.high, 3.0 + half, 1e-15);
}

TEST(MeasurePolyhedra, PartsMakeTheWhole) {
    Random random(7, 1, 0);
    for (int turn = 0; turn < 50; ++turn) {
        const State state = state_of(turn % 2 == 0 ? tetrahedron() : cube(0.6),
                                     Vec3(random.uniform(), random.uniform(), random.uniform()),
                                     testing::some_rotation(static_cast<std::uint64_t>(turn)));
        const double volume = volume_of(state, 0);
        double boxes = 0.0, slabs = 0.0;
        for (int i = -4; i < 8; ++i)
            for (int j = -4; j < 8; ++j)
                for (int k = -4; k < 8; ++k)
                    boxes += part_in(BoxRegion{0.3 * Vec3(i, j, k), 0.3 * Vec3(i + 1, j + 1, k + 1)}, state, 0);
        const Vec3 axis = Vec3(random.normal(), random.normal(), random.normal()).normalized();
        for (int i = -20; i < 20; ++i) slabs += part_between(state, 0, axis, 0.2 * i, 0.2 * (i + 1));
        EXPECT_NEAR(boxes, volume, 1e-14);
        EXPECT_NEAR(slabs, volume, 1e-14);
    }
}

TEST(MeasurePolyhedra, SpheresAreAsEver) {
    State state = in_place(cube(1.0));
    state.bodies.shape[0] = kSphere;
    state.bodies.radius[0] = 0.5;
    state.bodies.position[0] = Vec3(0, 0, 0.25);
    EXPECT_DOUBLE_EQ(part_in(kBelow, state, 0), std::numbers::pi / 12.0);
    EXPECT_DOUBLE_EQ(volume_of(state, 0), std::numbers::pi / 6.0);
    EXPECT_EQ(reach_of(state, 0, Vec3::UnitZ()).high, 0.75);
}

}  // namespace
}  // namespace scree::solvers::detail
