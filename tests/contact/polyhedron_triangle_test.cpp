// Convex polyhedra on terrain: what all triangles together report, against the distance of the bodies' features.
#include "contact/polyhedra/polyhedron_triangle.hpp"

#include <gtest/gtest.h>

#include "tests/testing/slow_polyhedra.hpp"
#include "tests/testing/terrain.hpp"

namespace scree::contact {
namespace {

using testing::Body;

constexpr double kDepth = 0.05;

std::vector<ManifoldPoint> touch(const TerrainMesh& mesh, const Placed& body, double margin, double* area = nullptr) {
    std::vector<ManifoldPoint> all;
    PolyhedraScratch scratch;
    Manifold found;
    for (std::uint32_t t = 0; t < mesh.triangle.size(); ++t) {
        polyhedron_triangle(body, mesh, t, kDepth, margin, scratch, found);
        all.insert(all.end(), found.points().begin(), found.points().end());
        if (area != nullptr) *area += found.area;
    }
    return all;
}

double rough(double x, double y) {
    return 0.4 * std::sin(1.7 * x) * std::cos(1.3 * y) + 0.2 * std::sin(5.0 * x + 1.0) * std::sin(4.0 * y);
}

std::vector<ConvexShape> shapes() {
    Random random(71, 1, 0);
    return {testing::box_shape({0.5, 0.4, 0.3}), testing::tetrahedron_shape(0.6),
            testing::rock_shape(12, {0.35, 0.3, 0.25}, random), testing::rock_shape(30, {0.35, 0.3, 0.25}, random)};
}

// Distance of a body above the surface: vertices of either over faces of the other, edges and edges.
double slow_from_surface(const TerrainMesh& mesh, const Placed& body) {
    double least = 1e300;
    for (const auto& t : mesh.triangle) {
        for (const Vec3& v : body.vertex) {
            const Vec3 x = body.position + v;
            bool inside = true;
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 &p = mesh.vertex[t.corner[i]], &q = mesh.vertex[t.corner[(i + 1) % 3]];
                inside = inside && t.normal.dot((q - p).cross(x - p)) >= 0.0;
            }
            if (inside) least = std::min(least, std::abs(t.normal.dot(x - mesh.vertex[t.corner[0]])));
        }
    }
    Vec3 d;
    for (const Vec3& v : mesh.vertex) {
        for (std::size_t f = 0; f < body.normal.size(); ++f) {
            if (testing::foot_within(body, f, v - body.position, d)) least = std::min(least, d.norm());
        }
    }
    for (const auto& e : mesh.edge) {
        for (const auto& f : body.shape->edge) {
            const Vec3 way =
                testing::between_segments(mesh.vertex[e.from], mesh.vertex[e.to], body.position + body.vertex[f.from],
                                          body.position + body.vertex[f.to]);
            least = std::min(least, way.norm());
        }
    }
    return least;
}

// Falls from above by no more than its distance at a time until it is `gap` away.
void land(const TerrainMesh& mesh, Body& body, double gap) {
    for (int k = 0; k < 500; ++k) {
        const double distance = slow_from_surface(mesh, body);
        if (distance < 1.01 * gap) return;
        body.placed.position.z() -= distance - gap;
    }
}

double least_of(const std::vector<ManifoldPoint>& points) {
    double least = 1e300;
    for (const ManifoldPoint& p : points) least = std::min(least, p.gap);
    return least;
}

// Bodies that have just come down: the least gap is the distance, and nobody is said to overlap.
TEST(PolyhedronTriangle, LandingOnRoughGround) {
    const TerrainMesh mesh = testing::grid_terrain(6, 0.4, rough);
    int tested = 0, off = 0;
    for (const ConvexShape& shape : shapes()) {
        for (std::uint64_t i = 0; i < 150; ++i) {
            Random random(71, 2, i);
            const double x = random.uniform(-0.7, 0.7), y = random.uniform(-0.7, 0.7);
            Body body(shape, {x, y, 2.0}, testing::random_turn(random));
            land(mesh, body, 1e-7);
            const double distance = slow_from_surface(mesh, body);
            if (distance > 2e-7) continue;
            ++tested;
            const std::vector<ManifoldPoint> found = touch(mesh, body, 1e-3);
            ASSERT_FALSE(found.empty()) << i;
            ASSERT_NEAR(least_of(found), distance, 1e-12) << i;
            for (const ManifoldPoint& p : found) {
                ASSERT_NEAR(p.normal.norm(), 1.0, 1e-14);
                ASSERT_GT(p.normal.z(), 0.0);
            }
            // Deeper by a little along the normal there: it is noticed. Next to a ridge a neighbour may answer too,
            // along its own normal, which is longer by the cosine.
            const auto deepest = std::min_element(found.begin(), found.end(),
                                                  [](const auto& p, const auto& q) { return p.gap < q.gap; });
            body.placed.position -= (distance + 1e-5) * deepest->normal;
            const double depth = -least_of(touch(mesh, body, 1e-3));
            ASSERT_GT(depth, 0.8e-5) << i;
            ASSERT_LT(depth, 3e-5) << i;
            off += std::abs(depth - 1e-5) > 1e-8 ? 1 : 0;
        }
    }
    EXPECT_GT(tested, 500);
    EXPECT_LT(off, tested / 20);
    std::printf("    %d landed, %d of another depth a little deeper\n", tested, off);
}

// On a plane cut into triangles a body touches with what it would touch a plane with, wherever it is.
TEST(PolyhedronTriangle, NoGhostsOnAPlane) {
    const auto slope = [](double x, double y) { return 0.3 * x - 0.2 * y; };
    const TerrainMesh mesh = testing::grid_terrain(8, 0.25, slope);
    const Vec3 n = Vec3(-0.3, 0.2, 1.0).normalized();
    const Vec3 across = Vec3::UnitZ().cross(n);
    const Quat tilt(Eigen::AngleAxisd(std::asin(across.norm()), across.normalized()));
    const ConvexShape box = testing::box_shape({0.5, 0.4, 0.3});
    for (std::uint64_t i = 0; i < 500; ++i) {
        Random random(71, 3, i);
        const double x = random.uniform(-0.4, 0.4), y = random.uniform(-0.4, 0.4), gap = random.uniform(-0.01, 0.01);
        const Quat turn(Eigen::AngleAxisd(random.uniform(0.0, 3.0), Vec3::UnitZ()));
        const Body body(box, Vec3(x, y, slope(x, y)) + (0.15 + gap) * n, tilt * turn);
        double area = 0.0;
        const std::vector<ManifoldPoint> found = touch(mesh, body, 0.02, &area);
        ASSERT_EQ(found.size(), 4U) << i;  // its four lower corners, and nothing of the triangles' edges
        for (const ManifoldPoint& p : found) {
            ASSERT_NEAR(p.gap, gap, 1e-14);
            ASSERT_LT((p.normal - n).norm(), 1e-14);
        }
        ASSERT_NEAR(area, 0.2, 1e-12);
    }
    for (std::uint64_t i = 0; i < 500; ++i) {  // any way up, sunk in a little
        Random random(71, 4, i);
        const double x = random.uniform(-0.4, 0.4), y = random.uniform(-0.4, 0.4);
        Body body(box, Vec3(x, y, slope(x, y)), testing::random_turn(random));
        body.placed.position += (-lowest(body, n).height - 0.005) * n;
        const std::vector<ManifoldPoint> found = touch(mesh, body, 0.01);
        std::size_t expected = 0;
        for (const Vec3& v : body.placed.vertex) {
            const Vec3 on = body.placed.position + v;
            expected += n.dot(on) <= 0.01 ? 1 : 0;
        }
        ASSERT_EQ(found.size(), expected) << i;
        for (const ManifoldPoint& p : found) ASSERT_LT((p.normal - n).norm(), 1e-14);
    }
}

TEST(PolyhedronTriangle, ARidgeAcrossAFace) {
    const TerrainMesh mesh = testing::grid_terrain(2, 1.0, [](double x, double) { return -0.5 * std::abs(x); });
    const ConvexShape box = testing::box_shape({0.5, 0.4, 0.3});
    for (const double gap : {-1e-4, 1e-4}) {
        const Body body(box, {0.05, 0.1, 0.15 + gap}, Quat::Identity());
        const std::vector<ManifoldPoint> found = touch(mesh, body, 1e-3);
        ASSERT_EQ(found.size(), 2U);  // where the ridge leaves the box's face
        for (const ManifoldPoint& p : found) {
            EXPECT_NEAR(p.gap, gap, 1e-14);
            EXPECT_LT((p.normal - Vec3::UnitZ()).norm(), 1e-12);
            EXPECT_NEAR(p.point.x(), 0.0, 1e-12);
        }
    }
}

TEST(PolyhedronTriangle, AVertexInTheMiddleOfAFace) {
    const TerrainMesh mesh =
        testing::grid_terrain(2, 1.0, [](double x, double y) { return -0.5 * (std::abs(x) + std::abs(y)); });
    const ConvexShape box = testing::box_shape({0.5, 0.4, 0.3});
    const Body body(box, {0.05, 0.1, 0.15 - 1e-4}, Quat::Identity());
    const std::vector<ManifoldPoint> found = touch(mesh, body, 1e-3);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].gap, -1e-4, 1e-15);
    EXPECT_LT((found[0].normal - Vec3::UnitZ()).norm(), 1e-15);
}

}  // namespace
}  // namespace scree::contact
