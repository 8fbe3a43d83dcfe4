// Shapes from vertices and faces: closed forms, an oracle that slices the hull of the points, bodies far away and thin,
// and every way not to be a body.
#include "core/make_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "core/random.hpp"
#include "tests/testing/slices.hpp"
#include "tests/testing/some_rotation.hpp"

namespace scree {
namespace {

using testing::some_rotation;

Polyhedron box(const Vec3& size) {
    Polyhedron body;
    for (int k = 0; k < 8; ++k)
        body.vertex.emplace_back((k & 1 ? 0.5 : -0.5) * size.x(), (k & 2 ? 0.5 : -0.5) * size.y(),
                                 (k & 4 ? 0.5 : -0.5) * size.z());
    body.face = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return body;
}
Polyhedron triangles_of(const Polyhedron& body) {
    Polyhedron cut{body.vertex, {}};
    for (const auto& loop : body.face)
        for (std::size_t k = 2; k < loop.size(); ++k) cut.face.push_back({loop[0], loop[k - 1], loop[k]});
    return cut;
}
Polyhedron moved(Polyhedron body, const Quat& rotation, const Vec3& shift) {
    for (Vec3& x : body.vertex) x = rotation * x + shift;
    return body;
}
Polyhedron random_hull(std::uint64_t seed, int points) {
    Random random(seed, 1, 0);
    std::vector<Vec3> x;
    for (int k = 0; k < points; ++k) x.emplace_back(random.normal(), 0.6 * random.normal(), 0.3 * random.normal());
    return testing::brute_hull(x);
}

ShapeFault fault_of(const Polyhedron& body, const std::string& message) {
    try {
        make_shape(body);
    } catch (const ShapeError& error) {
        EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
        EXPECT_EQ(error.code(), ExitCode::invalid_scenario);
        return error.fault();
    }
    ADD_FAILURE() << "this was taken for a body";
    return {};
}

// What every shape must be, whatever it was made from.
void expect_sound(const ConvexShape& shape, double tolerance = 1e-9) {
    const double size = 2.0 * shape.radius;
    const auto vertices = shape.vertex.size(), faces = shape.face.size(), edges = shape.edge.size();
    EXPECT_EQ(vertices + faces, edges + 2);
    EXPECT_EQ(shape.corner.size(), 2 * edges);
    EXPECT_EQ(shape.link.size(), 2 * edges);
    ASSERT_EQ(shape.link_begin.size(), vertices + 1);
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    for (const auto& edge : shape.edge) {
        EXPECT_LT(edge.from, edge.to);
        EXPECT_TRUE(seen.insert({edge.from, edge.to}).second);
        const auto has = [&](std::uint32_t face, std::uint32_t from, std::uint32_t to) {
            const auto loop = shape.corners(face);
            for (std::size_t k = 0; k < loop.size(); ++k)
                if (loop[k] == from && loop[(k + 1) % loop.size()] == to) return true;
            return false;
        };
        EXPECT_TRUE(has(edge.left, edge.from, edge.to));
        EXPECT_TRUE(has(edge.right, edge.to, edge.from));
        // faces are merged: neighbours differ in some corner by more than the tolerance
        const auto& face = shape.face[edge.left];
        double deepest = 0.0;
        for (const std::uint32_t v : shape.corners(edge.right))
            deepest = std::max(deepest, face.offset - face.normal.dot(shape.vertex[v]));
        EXPECT_GT(deepest, 0.5 * tolerance * size);
    }
    for (std::size_t v = 0; v < vertices; ++v) {
        const auto links = shape.links(v);
        EXPECT_GE(links.size(), 3U);
        EXPECT_TRUE(std::is_sorted(links.begin(), links.end()));
        for (const std::uint32_t other : links) {
            const auto v32 = static_cast<std::uint32_t>(v);
            EXPECT_TRUE(seen.count({std::min(v32, other), std::max(v32, other)}));
        }
    }
    for (std::size_t f = 0; f < faces; ++f) {
        EXPECT_NEAR(shape.face[f].normal.norm(), 1.0, 1e-15);
        for (const Vec3& x : shape.vertex) EXPECT_LE(shape.face[f].normal.dot(x), shape.face[f].offset);
        for (const std::uint32_t v : shape.corners(f))
            EXPECT_NEAR(shape.face[f].normal.dot(shape.vertex[v]), shape.face[f].offset, 8.0 * tolerance * size);
    }
    EXPECT_GT(shape.volume, 0.0);
    EXPECT_GT(shape.inertia[0], 0.0);
    EXPECT_LE(shape.inertia[0], shape.inertia[1]);
    EXPECT_LE(shape.inertia[1], shape.inertia[2]);
    EXPECT_LE(shape.inertia[2], shape.inertia[0] + shape.inertia[1]);
    EXPECT_GT(shape.inner_radius, 0.0);
    EXPECT_LT(shape.inner_radius, shape.radius);
}

TEST(MakeShape, BoxAlongTheAxesIsNotTurned) {
    const auto placed = make_shape(moved(box({3.0, 2.0, 1.0}), Quat::Identity(), {5.0, 6.0, 7.0}));
    const ConvexShape& shape = placed.shape;
    expect_sound(shape);
    EXPECT_EQ(shape.vertex.size(), 8U);
    EXPECT_EQ(shape.face.size(), 6U);
    EXPECT_EQ(shape.edge.size(), 12U);
    EXPECT_EQ(placed.centre, Vec3(5.0, 6.0, 7.0));
    EXPECT_TRUE(placed.rotation.coeffs() == Quat::Identity().coeffs());
    EXPECT_NEAR(shape.volume, 6.0, 1e-14);
    EXPECT_LT((shape.inertia - Vec3(5.0, 10.0, 13.0) * 0.5).norm(), 1e-14);  // V (b^2 + c^2) / 12
    EXPECT_NEAR(shape.radius, std::sqrt(3.5), 1e-15);
    EXPECT_EQ(shape.inner_radius, 0.5);
    for (std::size_t f = 0; f < 6; ++f) EXPECT_EQ(shape.face[f].normal.cwiseAbs().maxCoeff(), 1.0);
}

TEST(MakeShape, LongestAxisComesFirst) {
    const auto placed = make_shape(box({1.0, 2.0, 3.0}));
    EXPECT_LT((placed.shape.inertia - Vec3(5.0, 10.0, 13.0) * 0.5).norm(), 1e-14);
    const Mat3 axes = placed.rotation.toRotationMatrix();
    EXPECT_LT((axes.col(0) - Vec3::UnitZ()).norm(), 1e-15);
    EXPECT_LT((axes.col(1) - Vec3::UnitY()).norm(), 1e-15);
    EXPECT_LT((axes.col(2) + Vec3::UnitX()).norm(), 1e-15);  // right-handed
}

TEST(MakeShape, EqualMomentsLeaveTheAxesAlone) {
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        const auto placed = make_shape(moved(box({1.0, 1.0, 1.0}), some_rotation(seed), {10.0, -20.0, 5.0}));
        EXPECT_LT(placed.rotation.angularDistance(Quat::Identity()), 1e-12);
        EXPECT_EQ(placed.shape.inertia[0], placed.shape.inertia[2]);
        EXPECT_NEAR(placed.shape.inertia[0], 1.0 / 6.0, 1e-13);
    }
}

TEST(MakeShape, RegularTetrahedron) {
    const Polyhedron body{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                          {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
    const auto placed = make_shape(body);
    expect_sound(placed.shape);
    const double edge = std::sqrt(8.0);
    EXPECT_NEAR(placed.shape.volume, edge * edge * edge / (6.0 * std::sqrt(2.0)), 1e-14);
    EXPECT_LT((placed.shape.inertia / placed.shape.volume - Vec3::Constant(edge * edge / 20.0)).norm(), 1e-14);
    EXPECT_NEAR(placed.shape.radius / placed.shape.inner_radius, 3.0, 1e-14);
}

TEST(MakeShape, RegularOctahedron) {
    const Polyhedron body{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
    const auto placed = make_shape(body);
    expect_sound(placed.shape);
    EXPECT_NEAR(placed.shape.volume, 4.0 / 3.0, 1e-15);
    EXPECT_LT((placed.shape.inertia / placed.shape.volume - Vec3::Constant(0.2)).norm(), 1e-15);  // a^2 / 10, a^2 = 2
    EXPECT_NEAR(placed.shape.inner_radius, 1.0 / std::sqrt(3.0), 1e-15);
}

TEST(MakeShape, PrismWithASideOfEveryShape) {
    constexpr int kSides = 7;
    const double length = 4.0;
    Polyhedron body;
    std::vector<std::uint32_t> bottom, top;
    for (std::uint32_t k = 0; k < kSides; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kSides;
        body.vertex.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        body.vertex.emplace_back(std::cos(angle), std::sin(angle), length);
        bottom.insert(bottom.begin(), 2 * k);
        top.push_back(2 * k + 1);
        const std::uint32_t next = (k + 1) % kSides;
        body.face.push_back({2 * k, 2 * next, 2 * next + 1, 2 * k + 1});
    }
    body.face.push_back(bottom);
    body.face.push_back(top);
    const auto placed = make_shape(body);
    expect_sound(placed.shape);
    const double turn = 2.0 * std::numbers::pi / kSides, area = 0.5 * kSides * std::sin(turn);
    const double across =
        area * (2.0 + std::cos(turn)) / 12.0;  // second moment of the polygon about a line through its centre
    EXPECT_NEAR(placed.shape.volume, area * length, 1e-13);
    EXPECT_NEAR(placed.shape.inertia[0], 2.0 * across * length, 1e-13);
    EXPECT_NEAR(placed.shape.inertia[1], across * length + area * length * length * length / 12.0, 1e-13);
    EXPECT_EQ(placed.shape.inertia[1], placed.shape.inertia[2]);
    EXPECT_LT((placed.centre - Vec3(0.0, 0.0, 2.0)).norm(), 1e-14);
}

TEST(MakeShape, RandomHullsAgreeWithSlices) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const Polyhedron hull = random_hull(seed, 4 + static_cast<int>(seed % 13));
        const auto placed = make_shape(hull);
        expect_sound(placed.shape);
        const testing::Moments oracle = testing::moments_by_slices(hull.vertex);
        const double size = 2.0 * placed.shape.radius;
        EXPECT_NEAR(placed.shape.volume / oracle.volume, 1.0, 1e-12);
        EXPECT_LT((placed.centre - oracle.centre).norm(), 1e-12 * size);
        const Vec3 moments = testing::principal_moments(oracle.second);
        EXPECT_LT((placed.shape.inertia - moments).norm(), 1e-12 * moments.norm());
        // the axes: the tensor of the shape, turned back, is the oracle's
        const Mat3 axes = placed.rotation.toRotationMatrix();
        const Mat3 inertia = axes * placed.shape.inertia.asDiagonal() * axes.transpose();
        const Mat3 expected = oracle.second.trace() * Mat3::Identity() - oracle.second;
        EXPECT_LT((inertia - expected).norm(), 1e-12 * expected.norm());
        EXPECT_NEAR(axes.determinant(), 1.0, 1e-14);
    }
}

TEST(MakeShape, ThePlacementPutsEveryVertexBack) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Polyhedron hull = random_hull(seed, 10);
        const Polyhedron back = polyhedron_of(make_shape(hull));
        for (const Vec3& x : back.vertex) {
            double nearest = 1e300;
            for (const Vec3& y : hull.vertex) nearest = std::min(nearest, (x - y).norm());
            EXPECT_LT(nearest, 1e-14);
        }
    }
}

// Coordinates 10^6 sizes away carry 10 digits of the body: that much remains of its moments, and the shape is the same.
TEST(MakeShape, FarAwayItLosesTheDigitsThatCoordinatesLose) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Polyhedron hull = random_hull(seed, 12);
        const auto near = make_shape(hull), turned = make_shape(moved(hull, some_rotation(seed), Vec3::Zero()));
        EXPECT_NEAR(turned.shape.volume / near.shape.volume, 1.0, 1e-14);
        EXPECT_LT((turned.shape.inertia - near.shape.inertia).norm(), 1e-13 * near.shape.inertia.norm());
        const double size = 2.0 * near.shape.radius;
        const Vec3 shift = 1e6 * size * Vec3(0.8, -0.5, 0.3);
        const auto far = make_shape(moved(hull, some_rotation(seed), shift));
        expect_sound(far.shape);
        EXPECT_EQ(far.shape.face.size(), near.shape.face.size());
        EXPECT_NEAR(far.shape.volume / near.shape.volume, 1.0, 5e-9);
        EXPECT_LT((far.shape.inertia - near.shape.inertia).norm(), 5e-9 * near.shape.inertia.norm());
        EXPECT_LT((far.centre - shift - turned.centre).norm(), 5e-10 * size);
    }
}

TEST(MakeShape, ACubeFarAwayIsStillACube) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto far = make_shape(triangles_of(moved(box({1, 1, 1}), some_rotation(seed), {5.4e5, 5.5e6, 2e3})));
        EXPECT_EQ(far.shape.face.size(), 6U);
        EXPECT_LT(far.rotation.angularDistance(Quat::Identity()), 1e-6);
        EXPECT_NEAR(far.shape.volume, 1.0, 1e-8);
    }
}

TEST(MakeShape, NeedlesAndPlatesOfAMillionthKeepTheirMoments) {
    for (const Vec3& size : {Vec3(1.0, 1e-6, 1e-6), Vec3(1.0, 1e-6, 2e-6), Vec3(1.0, 1.0, 1e-6), Vec3(1.0, 1e-3, 1e-6)})
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            const auto placed = make_shape(triangles_of(moved(box(size), some_rotation(seed), {0.1, 0.2, 0.3})));
            expect_sound(placed.shape);
            EXPECT_EQ(placed.shape.face.size(), 6U);
            const Vec3 square = size.cwiseProduct(size);
            const double volume = size.prod();
            EXPECT_NEAR(placed.shape.volume / volume, 1.0, 1e-9);
            const Vec3 expected =
                volume / 12.0 * Vec3(square[1] + square[2], square[0] + square[2], square[0] + square[1]);
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(placed.shape.inertia[k] / expected[k], 1.0, 1e-9);
        }
}

TEST(MakeShape, EverySizeGivesTheSameShape) {
    const Polyhedron hull = random_hull(3, 12);
    const auto one = make_shape(hull);
    for (const double factor : {0x1p-40, 0x1p-20, 0x1p30}) {
        Polyhedron other = hull;
        for (Vec3& x : other.vertex) x *= factor;
        const auto placed = make_shape(other);
        EXPECT_EQ(placed.shape.volume, one.shape.volume * factor * factor * factor);
        EXPECT_EQ(placed.shape.inertia, Vec3(one.shape.inertia * std::pow(factor, 5)));
        EXPECT_EQ(scaled(one.shape, factor).radius, placed.shape.radius);
        EXPECT_EQ(scaled(one.shape, factor).inertia, placed.shape.inertia);
    }
}

TEST(MakeShape, TrianglesInOnePlaneAreOneFace) {
    const auto placed = make_shape(triangles_of(moved(box({1, 2, 3}), some_rotation(7), {3, 4, 5})));
    expect_sound(placed.shape);
    EXPECT_EQ(placed.shape.face.size(), 6U);
}

TEST(MakeShape, CornersOnAnEdgeVanish) {
    Polyhedron body = box({1, 2, 3});  // a vertex in the middle of the edge between 0 and 1
    body.vertex.push_back(0.5 * (body.vertex[0] + body.vertex[1]));
    body.face[2] = {0, 8, 1, 5, 4};
    body.face[4] = {0, 2, 3, 1, 8};
    const auto placed = make_shape(body);
    expect_sound(placed.shape);
    EXPECT_EQ(placed.shape.vertex.size(), 8U);
}

TEST(MakeShape, ShortEdgesVanish) {
    Polyhedron body = box({1, 2, 3});  // the corner 0 cut off within the tolerance
    const double tiny = 1e-10;
    body.vertex.push_back(body.vertex[0] + Vec3(tiny, 0, 0));
    body.vertex.push_back(body.vertex[0] + Vec3(0, tiny, 0));
    body.vertex[0].z() += tiny;
    body.face = {{0, 4, 6, 2, 9}, {1, 3, 7, 5}, {0, 8, 1, 5, 4}, {2, 6, 7, 3},
                 {9, 2, 3, 1, 8}, {4, 5, 7, 6}, {0, 9, 8}};
    const auto placed = make_shape(body);
    expect_sound(placed.shape);
    EXPECT_EQ(placed.shape.vertex.size(), 8U);
    EXPECT_EQ(placed.shape.face.size(), 6U);
    EXPECT_NEAR(placed.shape.volume, 6.0, 1e-9);
}

TEST(MakeShape, TheSameInputGivesTheSameBits) {
    const Polyhedron hull = random_hull(9, 14);
    const auto a = make_shape(hull), b = make_shape(hull);
    EXPECT_TRUE(a.shape.vertex == b.shape.vertex);
    EXPECT_EQ(a.shape.inertia, b.shape.inertia);
}

TEST(NotAShape, NamesWhatIsWrong) {
    const Polyhedron good = box({1, 1, 1});
    Polyhedron body = good;
    body.vertex[3].y() = std::nan("");
    EXPECT_EQ(fault_of(body, "vertex 3"), ShapeFault::not_finite);
    EXPECT_EQ(fault_of({}, "0 vertices and 0 faces"), ShapeFault::too_few);
    body = good;
    body.face[1] = {1, 3, 99};
    EXPECT_EQ(fault_of(body, "face 1 names vertex 99, but there are only 8"), ShapeFault::bad_face);
    body.face[1] = {1, 3, 1, 5};
    EXPECT_EQ(fault_of(body, "face 1 has vertex 1 more than once"), ShapeFault::bad_face);
    body.face[1] = {1, 3};
    EXPECT_EQ(fault_of(body, "face 1 has 2 corners"), ShapeFault::bad_face);
    body = good;
    body.face.pop_back();
    EXPECT_EQ(fault_of(body, "4 of its 12 edges belong to one face only"), ShapeFault::not_closed);
    body = good;
    std::reverse(body.face[2].begin(), body.face[2].end());
    EXPECT_EQ(fault_of(body, "inside out"), ShapeFault::not_oriented);
    for (auto& loop : body.face) std::reverse(loop.begin(), loop.end());
    std::reverse(body.face[2].begin(), body.face[2].end());
    EXPECT_EQ(fault_of(body, "volume is -1 m3"), ShapeFault::not_oriented);
    body = good;
    body.face.push_back(body.face[0]);
    EXPECT_EQ(fault_of(body, "belongs to 3 faces"), ShapeFault::not_manifold);
}

TEST(NotAShape, TwoBodiesAreNotOne) {
    Polyhedron body = box({1, 1, 1});
    const Polyhedron other = moved(box({1, 1, 1}), Quat::Identity(), {3, 0, 0});
    body.vertex.insert(body.vertex.end(), other.vertex.begin(), other.vertex.end());
    for (auto loop : other.face) {
        for (std::uint32_t& v : loop) v += 8;
        body.face.push_back(loop);
    }
    EXPECT_EQ(fault_of(body, "2 separate surfaces"), ShapeFault::not_connected);
}

TEST(NotAShape, AFrameHasAHole) {
    // a square ring of four bars: 16 vertices, 16 faces
    Polyhedron body;
    for (const double z : {0.0, 1.0})
        for (const double r : {2.0, 1.0})
            for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
                body.vertex.emplace_back(r * x, r * y, z);
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t n = (k + 1) % 4;
        body.face.push_back({k, n, n + 8, k + 8});            // outside
        body.face.push_back({n + 4, k + 4, k + 12, n + 12});  // inside
        body.face.push_back({k + 8, n + 8, n + 12, k + 12});  // top
        body.face.push_back({n, k, k + 4, n + 4});            // bottom
    }
    EXPECT_EQ(fault_of(body, "= 0, where 2 is expected"), ShapeFault::not_manifold);
}

TEST(NotAShape, BentFacesAndDents) {
    Polyhedron body = box({1, 1, 1});
    body.vertex[7] += Vec3(0.1, 0.1, 0.1);
    EXPECT_EQ(fault_of(body, "are not in one plane"), ShapeFault::not_planar);
    body = triangles_of(box({1, 1, 1}));  // a pyramid into the top
    std::erase_if(body.face, [](const auto& loop) {
        return std::all_of(loop.begin(), loop.end(), [](auto v) { return v >= 4; });
    });
    body.vertex.emplace_back(0.0, 0.0, 0.2);
    for (const auto& [a, b] : {std::pair{4U, 5U}, {5U, 7U}, {7U, 6U}, {6U, 4U}}) body.face.push_back({a, b, 8U});
    EXPECT_EQ(fault_of(body, "outside of the plane of face"), ShapeFault::not_convex);
    body.vertex.back().z() = 0.5;  // flat: a cube again
    EXPECT_EQ(make_shape(body).shape.face.size(), 6U);
    body.vertex.back().z() = 0.5 - 1e-7;  // a dent just deeper than round-off
    EXPECT_EQ(fault_of(body, "not convex"), ShapeFault::not_convex);
}

TEST(NotAShape, FlatThinAndTooSmall) {
    EXPECT_EQ(fault_of(box({1, 1, 0}), "no volume"), ShapeFault::no_volume);
    EXPECT_EQ(fault_of(box({1, 1, 1e-10}), "no volume"), ShapeFault::no_volume);
    EXPECT_EQ(fault_of(box({1, 1e-10, 1e-10}), "no volume"), ShapeFault::no_volume);
    EXPECT_EQ(fault_of(box({1, 1, 4e-9}), "no volume"), ShapeFault::no_volume);
    EXPECT_EQ(fault_of(box({1e-80, 1e-80, 1e-80}), "no number can hold"), ShapeFault::not_finite);
    EXPECT_EQ(fault_of(box({1e80, 1e80, 1e80}), "no number can hold"), ShapeFault::not_finite);
}

}  // namespace
}  // namespace scree
