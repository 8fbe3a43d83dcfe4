// Bodies cut by planes: parts are closed bodies whose volumes add up, wherever the plane passes.
#include "scenarios/shapes/cut.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "core/volume_integrals.hpp"
#include "scenarios/shapes/rock.hpp"
#include "scenarios/shapes/solids.hpp"

namespace scree::scenarios {
namespace {

constexpr double kThickness = 1e-9;

Vec3 direction(Random& random) {
    return Vec3(random.normal(), random.normal(), random.normal()).normalized();
}
double volume_of(const Polyhedron& body) {
    return body.face.empty() ? 0.0 : volume_integrals(body).volume;
}
// Closed, oriented, of ball type: whatever the numbers are.
void expect_closed(const Polyhedron& body) {
    if (body.face.empty()) return;
    EXPECT_NO_THROW(check_loops(body));
    EXPECT_NO_THROW(edges_of(body));
}
void expect_parts(const Polyhedron& body, const CutPlane& plane, const CutParts& parts) {
    expect_closed(parts.below);
    expect_closed(parts.above);
    const double whole = volume_of(body);
    EXPECT_NEAR((volume_of(parts.below) + volume_of(parts.above)) / whole, 1.0, 1e-12);
    for (const Vec3& x : parts.below.vertex) EXPECT_LE(plane.normal.dot(x) - plane.offset, kThickness);
    for (const Vec3& x : parts.above.vertex) EXPECT_GE(plane.normal.dot(x) - plane.offset, -kThickness);
}

TEST(Cut, ACubeInHalves) {
    const Polyhedron body = polyhedron_of(box({2, 2, 2}));
    const CutPlane plane{Vec3(0, 0, 1), 0.5};
    const auto parts = cut(body, plane, kThickness);
    expect_parts(body, plane, parts);
    EXPECT_NEAR(volume_of(parts.below), 6.0, 1e-15);
    EXPECT_NEAR(volume_of(parts.above), 2.0, 1e-15);
    EXPECT_EQ(make_shape(parts.below).shape.face.size(), 6U);
    EXPECT_EQ(make_shape(parts.above).shape.vertex.size(), 8U);
    EXPECT_EQ(cut_below(body, plane, kThickness).face, parts.below.face);
}

TEST(Cut, AHexagonThroughTheMiddleOfACube) {
    const Polyhedron body = polyhedron_of(box({2, 2, 2}));
    const auto parts = cut(body, {Vec3(1, 1, 1).normalized(), 0.0}, kThickness);
    EXPECT_EQ(parts.below.face.back().size(), 6U);
    EXPECT_NEAR(volume_of(parts.below), 4.0, 1e-14);
    EXPECT_EQ(make_shape(parts.above).shape.face.size(), 7U);
}

// Planes through corners, edges and faces: no part, or a part with the corners in the plane found once.
TEST(Cut, ThroughCornersEdgesAndFaces) {
    const Polyhedron body = polyhedron_of(box({2, 2, 2}));
    const auto diagonal = cut(body, {Vec3(1, 1, 0).normalized(), 0.0}, kThickness);  // two edges in the plane
    EXPECT_NEAR(volume_of(diagonal.below), 4.0, 1e-14);
    for (const Polyhedron& half : {diagonal.below, diagonal.above}) {
        expect_closed(half);
        const auto shape = make_shape(half).shape;
        EXPECT_EQ(shape.vertex.size(), 6U);
        EXPECT_EQ(shape.face.size(), 5U);
    }
    for (const double noise : {0.0, 1e-17, -1e-17, 1e-15, -1e-15, 1e-13, 1e-11}) {
        EXPECT_TRUE(cut(body, {Vec3(0, 0, 1), 1.0 + noise}, kThickness).above.face.empty());  // a face
        EXPECT_TRUE(cut(body, {Vec3(0, 0, 1), -1.0 + noise}, kThickness).below.face.empty());
        EXPECT_TRUE(
            cut(body, {Vec3(0, 1, 1).normalized(), std::sqrt(2.0) + noise}, kThickness).above.face.empty());  // an edge
        EXPECT_TRUE(cut(body, {Vec3(1, 1, 1).normalized(), std::sqrt(3.0) + noise}, kThickness)
                        .above.face.empty());  // a corner
        const auto three =
            cut(body, {Vec3(1, 1, 1).normalized(), std::sqrt(1.0 / 3.0) + noise}, kThickness);  // three corners
        EXPECT_NEAR(volume_of(three.above), 4.0 / 3.0, 1e-10);
        EXPECT_EQ(make_shape(three.above).shape.vertex.size(), 4U);
        EXPECT_EQ(make_shape(three.below).shape.vertex.size(), 7U);
    }
}

void expect_volumes_add_up(const Polyhedron& body, const CutPlane& plane) {
    const auto parts = cut(body, plane, kThickness);
    expect_parts(body, plane, parts);
    double sum = 0.0;
    for (const Polyhedron& part : {parts.below, parts.above})
        if (!part.face.empty()) sum += make_shape(part).shape.volume;
    EXPECT_NEAR(sum / volume_of(body), 1.0, 1e-12);
}

TEST(Cut, RandomRocksByRandomPlanes) {
    for (std::uint64_t k = 0; k < 300; ++k) {
        Random random(1, 1, k);
        const Polyhedron body = polyhedron_of(random_rock({8 + static_cast<int>(k % 40), 0.8, 0.7}, Random(1, 2, k)));
        const CutPlane plane{direction(random), random.uniform(-0.3, 0.3)};
        expect_volumes_add_up(body, plane);
    }
}

// Planes through three corners of the body itself, off by nothing or by a few round-offs: the hardest to decide.
TEST(Cut, PlanesThroughThreeCorners) {
    for (std::uint64_t k = 0; k < 2000; ++k) {
        Random random(2, 1, k);
        const auto placed = k % 3 == 0   ? prism(3 + static_cast<int>(k % 9), 1.0, 1.0)
                            : k % 3 == 1 ? eota_block({1, 1, 1})
                                         : random_rock({12, 0.8, 0.7}, Random(2, 2, k));
        const Polyhedron body = polyhedron_of(placed);
        const auto corner = [&] { return body.vertex[random.bits() % body.vertex.size()]; };
        const Vec3 a = corner(), normal = (corner() - a).cross(corner() - a);
        if (normal.norm() < 1e-9) continue;
        const CutPlane plane{normal.normalized(), normal.normalized().dot(a) + random.uniform(-4e-16, 4e-16)};
        expect_volumes_add_up(body, plane);
    }
}

// All parts of parts: volumes still add up, and no part is anything but a body.
TEST(Cut, TwentyPlanesOneAfterTheOther) {
    for (std::uint64_t k = 0; k < 20; ++k) {
        const bool through_one_point = k % 2 == 0;  // many planes through one point: all that can meet there does
        std::vector<Polyhedron> parts = {polyhedron_of(box({1, 1, 1}))};
        Random random(3, 1, k);
        for (int planes = 0; planes < 20; ++planes) {
            const CutPlane plane{direction(random), through_one_point ? 0.0 : random.uniform(-0.3, 0.3)};
            std::vector<Polyhedron> next;
            for (const Polyhedron& part : parts) {
                const auto two = cut(part, plane, kThickness);
                for (const Polyhedron& half : {two.below, two.above})
                    if (!half.face.empty()) next.push_back(half);
            }
            parts = std::move(next);
        }
        double sum = 0.0, shapes = 0.0;
        for (const Polyhedron& part : parts) {
            expect_closed(part);
            sum += volume_of(part);
            shapes += make_shape(part).shape.volume;
        }
        EXPECT_GT(parts.size(), 200U);
        EXPECT_NEAR(sum, 1.0, 1e-13);
        EXPECT_NEAR(shapes, 1.0, 1e-12);
    }
}

}  // namespace
}  // namespace scree::scenarios
