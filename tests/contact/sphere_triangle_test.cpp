// Spheres on terrain: the triangles together against the distance to the whole surface, and no ghosts at inner edges.
#include "contact/polyhedra/sphere_triangle.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "tests/testing/slow_polyhedra.hpp"
#include "tests/testing/terrain.hpp"

namespace scree::contact {
namespace {

constexpr double kDepth = 0.1;

std::vector<SphereTriangleGap> touch(const TerrainMesh& mesh, const Vec3& centre, double radius, double margin) {
    std::vector<SphereTriangleGap> found;
    for (std::uint32_t t = 0; t < mesh.triangle.size(); ++t) {
        if (const auto gap = sphere_triangle(centre, radius, mesh, t, kDepth, margin)) found.push_back(*gap);
    }
    return found;
}

double rough(double x, double y) {
    return 0.4 * std::sin(1.7 * x) * std::cos(1.3 * y) + 0.2 * std::sin(5.0 * x + 1.0) * std::sin(4.0 * y);
}

// Vector from the nearest point of the surface.
Vec3 slow_from_surface(const TerrainMesh& mesh, const Vec3& x) {
    Vec3 best = Vec3::Constant(1e100);
    const auto take = [&](const Vec3& d) {
        if (d.norm() < best.norm()) best = d;
    };
    for (const auto& t : mesh.triangle) {
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 &p = mesh.vertex[t.corner[i]], &q = mesh.vertex[t.corner[(i + 1) % 3]];
            inside = inside && t.normal.dot((q - p).cross(x - p)) >= 0.0;
            take(testing::between_segments(x, x, p, q));
        }
        if (inside) take(t.normal.dot(x - mesh.vertex[t.corner[0]]) * t.normal);
    }
    return best;
}

// Height of the mesh over a place.
double ground(const TerrainMesh& mesh, double x, double y) {
    for (const auto& t : mesh.triangle) {
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 &p = mesh.vertex[t.corner[i]], &q = mesh.vertex[t.corner[(i + 1) % 3]];
            inside = inside && (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x()) >= 0.0;
        }
        const Vec3& p = mesh.vertex[t.corner[0]];
        if (inside) return p.z() - (t.normal.x() * (x - p.x()) + t.normal.y() * (y - p.y())) / t.normal.z();
    }
    return 0.0;
}

TEST(SphereTriangle, TheNearestPlaceIsThatOfTheSurface) {
    const TerrainMesh mesh = testing::grid_terrain(8, 0.5, rough);
    int regions[3] = {0, 0, 0};
    for (std::uint64_t i = 0; i < 3000; ++i) {
        Random random(61, 1, i);
        const double x = random.uniform(-1.6, 1.6), y = random.uniform(-1.6, 1.6), radius = random.uniform(0.05, 0.3);
        const Vec3 centre(x, y, ground(mesh, x, y) + random.uniform(0.0, 0.4));
        const Vec3 slow = slow_from_surface(mesh, centre);
        const std::vector<SphereTriangleGap> found = touch(mesh, centre, radius, 10.0);
        ASSERT_FALSE(found.empty());
        const auto nearest =
            std::min_element(found.begin(), found.end(), [](const auto& p, const auto& q) { return p.gap < q.gap; });
        ASSERT_NEAR(nearest->gap, slow.norm() - radius, 1e-14) << i;
        ASSERT_LT((nearest->normal - slow.normalized()).norm(), 1e-12) << i;
        ++regions[static_cast<int>(nearest->region)];
        // each place once, and each a place where the distance has a least value of its own
        for (const auto& p : found) {
            ASSERT_NEAR(p.normal.norm(), 1.0, 1e-14);
            for (const auto& q : found) ASSERT_TRUE(&p == &q || p.region != q.region || p.feature != q.feature);
        }
    }
    for (const int seen : regions) EXPECT_GT(seen, 20);
}

// A plane cut into triangles is a plane, also exactly above its edges and vertices.
TEST(SphereTriangle, NoGhostsOnAPlane) {
    const Vec3 normal = Vec3(-0.3, 0.2, 1.0).normalized();
    for (const bool level : {true, false}) {
        const TerrainMesh mesh =
            testing::grid_terrain(8, 0.5, [&](double x, double y) { return level ? 0.0 : 0.3 * x - 0.2 * y; });
        const Vec3 n = level ? Vec3(Vec3::UnitZ()) : normal;
        for (std::uint64_t i = 0; i < 3000; ++i) {
            Random random(61, 2, i);
            Vec3 on(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), 0.0);
            if (i % 3 == 0) on.x() = 0.5 * std::round(2.0 * on.x());
            if (i % 9 == 0) on.y() = 0.5 * std::round(2.0 * on.y());
            if (!level) on.z() = 0.3 * on.x() - 0.2 * on.y();
            const double height = random.uniform(0.0, 0.3);
            const auto found = touch(mesh, on + height * n, 0.2, 0.15);
            ASSERT_FALSE(found.empty()) << i;
            // straight above an edge or a vertex round-off may let several answer, with one voice
            ASSERT_LE(found.size(), i % 9 == 0 ? 9U : i % 3 == 0 ? 2U : 1U) << i;
            for (const auto& p : found) {
                ASSERT_NEAR(p.gap, height - 0.2, 1e-14);
                if (height > 1e-3) {
                    ASSERT_LT((p.normal - n).norm(), 1e-11) << i;
                }
            }
        }
    }
}

// Rolling over rough ground: the least gap changes by at most the way.
TEST(SphereTriangle, ContinuousAlongAWay) {
    const TerrainMesh mesh = testing::grid_terrain(8, 0.5, rough);
    for (std::uint64_t i = 0; i < 40; ++i) {
        Random random(61, 3, i);
        const double x0 = random.uniform(-1.5, 1.5), y0 = random.uniform(-1.5, 1.5), up = random.uniform(0.0, 0.3);
        const Vec3 way = 1e-3 * Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 0.0);
        double before = 0.0;
        Vec3 last = Vec3::Zero();
        for (int k = 0; k < 1000; ++k) {
            Vec3 x = Vec3(x0, y0, 0.0) + k * way;
            if (std::abs(x.x()) > 1.6 || std::abs(x.y()) > 1.6) break;
            x.z() = ground(mesh, x.x(), x.y()) + up;
            double least = 1e300;
            for (const auto& p : touch(mesh, x, 0.2, 10.0)) least = std::min(least, p.gap);
            if (k > 0) {
                ASSERT_LE(std::abs(least - before), (x - last).norm() + 1e-14);
            }
            before = least, last = x;
        }
    }
}

TEST(SphereTriangle, ACentreBehindIsPushedOut) {
    const TerrainMesh mesh = testing::grid_terrain(4, 0.5, [](double, double) { return 0.0; });
    const auto found = touch(mesh, {0.13, 0.07, -0.1}, 0.2, 0.0);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].gap, -0.3, 1e-15);
    EXPECT_EQ(found[0].normal, Vec3::UnitZ());
    EXPECT_TRUE(touch(mesh, {0.13, 0.07, -1.1 * kDepth}, 0.2, 0.0).empty());
}

TEST(SphereTriangle, MeshesThatAreNone) {
    const std::vector<Vec3> p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    EXPECT_THROW(make_terrain_mesh(p, {{0, 1, 4}}), ScenarioError);
    EXPECT_THROW(make_terrain_mesh(p, {{0, 1, 1}}), ScenarioError);
    EXPECT_THROW(make_terrain_mesh(p, {{0, 1, 2}, {0, 1, 3}}), ScenarioError);
    EXPECT_THROW(make_terrain_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}), ScenarioError);
    EXPECT_EQ(make_terrain_mesh(p, {{0, 1, 2}, {2, 1, 3}}).edge.size(), 5U);
}

}  // namespace
}  // namespace scree::contact
