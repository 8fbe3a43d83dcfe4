// Solids in closed form and random rocks: volumes, moments, proportions, determinism.
#include "scenarios/shapes/solids.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenarios/shapes/rock.hpp"

namespace scree::scenarios {
namespace {

void expect_counts(const ConvexShape& shape, std::size_t vertices, std::size_t edges, std::size_t faces) {
    EXPECT_EQ(shape.vertex.size(), vertices);
    EXPECT_EQ(shape.edge.size(), edges);
    EXPECT_EQ(shape.face.size(), faces);
}
Vec3 sides_of(const PlacedShape& placed) {
    const Extent extent = extent_of(polyhedron_of(placed).vertex);
    return extent.upper - extent.lower;
}

TEST(Solids, Box) {
    const auto placed = box({0.3, 0.1, 0.2});
    expect_counts(placed.shape, 8, 12, 6);
    EXPECT_NEAR(placed.shape.volume, 0.006, 1e-17);
    EXPECT_LT((sides_of(placed) - Vec3(0.3, 0.1, 0.2)).norm(), 1e-16);
    const Vec3 expected = 0.006 / 12.0 * Vec3(0.05, 0.10, 0.13);
    EXPECT_LT((placed.shape.inertia - expected).norm(), 1e-15 * expected.norm());
}

TEST(Solids, Prisms) {
    for (const int sides : {3, 4, 6, 17, 64}) {
        const auto placed = prism(sides, 2.0, 5.0);
        const auto n = static_cast<std::size_t>(sides);
        expect_counts(placed.shape, 2 * n, 3 * n, n + 2);
        EXPECT_NEAR(placed.shape.volume, 2.5 * sides * std::sin(2.0 * std::numbers::pi / sides), 1e-13);
        EXPECT_NEAR(placed.shape.radius, std::sqrt(1.0 + 6.25), 1e-14);
    }
}

TEST(Solids, Platonic) {
    using std::numbers::phi;
    const double a = 0.7, s5 = std::sqrt(5.0);
    struct Case {
        Platonic solid;
        std::size_t vertices, edges, faces;
        double volume, moment;  // over a^3, over V a^2
    };
    for (const Case& c : {Case{Platonic::tetrahedron, 4, 6, 4, std::sqrt(2.0) / 12.0, 1.0 / 20.0},
                          Case{Platonic::cube, 8, 12, 6, 1.0, 1.0 / 6.0},
                          Case{Platonic::octahedron, 6, 12, 8, std::sqrt(2.0) / 3.0, 1.0 / 10.0},
                          Case{Platonic::dodecahedron, 20, 30, 12, (15.0 + 7.0 * s5) / 4.0, (95.0 + 39.0 * s5) / 300.0},
                          Case{Platonic::icosahedron, 12, 30, 20, 5.0 * (3.0 + s5) / 12.0, phi * phi / 10.0}}) {
        const auto placed = platonic(c.solid, a);
        expect_counts(placed.shape, c.vertices, c.edges, c.faces);
        EXPECT_NEAR(placed.shape.volume / (c.volume * a * a * a), 1.0, 1e-14);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(placed.shape.inertia[k] / (c.moment * placed.shape.volume * a * a), 1.0, 1e-14);
        for (const auto& edge : placed.shape.edge)
            EXPECT_NEAR((placed.shape.vertex[edge.from] - placed.shape.vertex[edge.to]).norm(), a, 1e-15);
        EXPECT_TRUE(placed.rotation.coeffs() == Quat::Identity().coeffs());
    }
}

TEST(Solids, EotaBlocks) {
    const auto cube = eota_block({2.0, 2.0, 2.0});
    expect_counts(cube.shape, 24, 48, 26);
    EXPECT_NEAR(cube.shape.volume, 17.0 / 24.0 * 8.0, 1e-14);
    // 1 m3 of the plate 221 has corners at 0.70669840263079309 m
    const auto plate = with_volume(eota_block({2.0, 2.0, 1.0}), 1.0);
    expect_counts(plate.shape, 24, 48, 26);
    EXPECT_NEAR(plate.shape.volume, 1.0, 1e-15);
    EXPECT_LT((sides_of(plate) - 2.0 * 0.70669840263079309 * Vec3(1.0, 1.0, 0.5)).norm(), 1e-14);
    EXPECT_EQ(plate.shape.inertia[0], plate.shape.inertia[1]);
    EXPECT_GT(plate.shape.inertia[2], plate.shape.inertia[1]);
}

TEST(Solids, NoLengthNoSolid) {
    EXPECT_THROW(box({1.0, 0.0, 1.0}), ShapeError);
    EXPECT_THROW(box({1.0, -1.0, -1.0}), ShapeError);
    EXPECT_THROW(box({1.0, std::nan(""), 1.0}), ShapeError);
    EXPECT_THROW(prism(2, 1.0, 1.0), ShapeError);
    EXPECT_THROW(platonic(Platonic::cube, INFINITY), ShapeError);
    EXPECT_THROW(eota_block({1.0, 1.0, 0.0}), ShapeError);
}

TEST(Solids, VolumeOfABall) {
    EXPECT_NEAR(with_volume(box({1, 2, 3}), ball_volume(0.5)).shape.volume, std::numbers::pi / 48.0, 1e-16);
}

TEST(RandomRock, HasItsFormAndItsPoints) {
    for (std::uint64_t k = 0; k < 200; ++k) {
        const RockForm form{6 + static_cast<int>(k % 50), 1.0 - 0.13 * static_cast<double>(k % 7),
                            1.0 - 0.22 * static_cast<double>(k % 5)};
        const auto placed = random_rock(form, Random(1, 2, k));
        EXPECT_EQ(placed.shape.vertex.size(), static_cast<std::size_t>(form.points));
        const Vec3 sides = sides_of(placed);
        EXPECT_NEAR(sides[0], 1.0, 1e-14);
        EXPECT_NEAR(sides[1] / sides[0], form.elongation, 1e-14);
        EXPECT_NEAR(sides[2] / sides[1], form.flatness, 1e-13);
    }
}

TEST(RandomRock, IsAFunctionOfItsDraws) {
    const RockForm form{14, 0.7, 0.6};
    const auto a = random_rock(form, Random(3, 1, 4)), b = random_rock(form, Random(3, 1, 4));
    EXPECT_TRUE(a.shape.vertex == b.shape.vertex);
    EXPECT_TRUE(a.shape.corner == b.shape.corner);
    EXPECT_FALSE(a.shape.vertex == random_rock(form, Random(3, 1, 5)).shape.vertex);
}

// Between the volume of the hull of independent points, a share 12/n below the ellipsoid's (Miles 1971), and the
// ellipsoid's.
TEST(RandomRock, RoundsTowardsTheEllipsoid) {
    double last = 0.0;
    for (const int points : {8, 20, 60, 200}) {
        double mean = 0.0;
        for (std::uint64_t k = 0; k < 50; ++k)
            mean += random_rock({points, 0.8, 0.5}, Random(1, 2, k)).shape.volume / 50.0;
        const double share = mean / (std::numbers::pi / 6.0 * 0.8 * 0.4);
        EXPECT_GT(share, last);
        EXPECT_LT(share, 1.05);
        last = share;
    }
    EXPECT_NEAR(last, 1.0, 12.0 / 200.0);
}

TEST(RandomRock, RefusesWhatIsNoForm) {
    EXPECT_THROW(random_rock({5, 0.5, 0.5}, Random(1, 1, 1)), ShapeError);
    EXPECT_THROW(random_rock({10, 1.5, 0.5}, Random(1, 1, 1)), ShapeError);
    EXPECT_THROW(random_rock({10, 0.5, 0.0}, Random(1, 1, 1)), ShapeError);
}

}  // namespace
}  // namespace scree::scenarios
