// Terrain: how cells are cut, holes and sides, and the lookup against a walk over all triangles.
#include "core/terrain.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/errors.hpp"
#include "tests/testing/height_grid.hpp"

namespace scree {
namespace {

using testing::flat_grid;
using testing::height_grid;
using testing::kNoData;
using testing::noisy_grid;

// The projected area of the ground [m2].
double ground_area(const Terrain& t) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < t.ground; ++i) {
        const auto& c = t.mesh.triangle[i].corner;
        const Vec3 p = t.mesh.vertex[c[1]] - t.mesh.vertex[c[0]], q = t.mesh.vertex[c[2]] - t.mesh.vertex[c[0]];
        sum += 0.5 * p.cross(q).z();
    }
    return sum;
}

std::size_t open_edges(const Terrain& t) {
    return static_cast<std::size_t>(std::count_if(t.mesh.edge.begin(), t.mesh.edge.end(), [](const auto& e) {
        return e.left == TerrainMesh::kNone || e.right == TerrainMesh::kNone;
    }));
}

bool touches(const Terrain& terrain, std::uint32_t t, const Vec3& lower, const Vec3& upper) {
    const auto& c = terrain.mesh.triangle[t].corner;
    const auto& v = terrain.mesh.vertex;
    const Vec3 low = v[c[0]].cwiseMin(v[c[1]]).cwiseMin(v[c[2]]), high = v[c[0]].cwiseMax(v[c[1]]).cwiseMax(v[c[2]]);
    return (low.array() <= upper.array()).all() && (lower.array() <= high.array()).all();
}

// Each triangle whose bounds meet the box is visited, each once, in increasing order.
void expect_whole_visits(const Terrain& terrain, std::uint64_t seed, double most_visited) {
    double visits = 0.0, needed = 0.0;
    const Vec3 size = terrain.upper - terrain.lower + Vec3::Constant(0.1);
    for (std::uint64_t i = 0; i < 400; ++i) {
        Random random(seed, 1, i);
        Vec3 centre;
        for (int k = 0; k < 3; ++k)
            centre[k] = random.uniform(terrain.lower[k] - 0.2 * size[k], terrain.upper[k] + 0.2 * size[k]);
        const Vec3 half = Vec3::Constant(random.uniform(0.0, 0.1) * size.maxCoeff());
        std::vector<std::uint32_t> seen, slow;
        terrain.visit(centre - half, centre + half, [&](std::uint32_t t) { seen.push_back(t); });
        ASSERT_TRUE(std::is_sorted(seen.begin(), seen.end()));
        ASSERT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
        for (std::uint32_t t = 0; t < terrain.mesh.triangle.size(); ++t)
            if (touches(terrain, t, centre - half, centre + half)) slow.push_back(t);
        ASSERT_TRUE(std::includes(seen.begin(), seen.end(), slow.begin(), slow.end())) << i;
        visits += static_cast<double>(seen.size()), needed += static_cast<double>(slow.size()) + 1.0;
    }
    EXPECT_LT(visits, most_visited * needed);
}

TEST(Terrain, CellsAreCutAlongTheMoreLevelDiagonal) {
    HeightGrid grid = height_grid(2, 2, 1.0, 1.0, [](double x, double y) { return x == y ? 0.0 : 1.0 + x; });
    // corners (0,0) and (1,1) are level: the cut joins them
    Terrain t = make_terrain(grid, TerrainBorder::open);
    EXPECT_EQ(t.mesh.triangle[0].corner, (TriangleCorners{0, 1, 3}));
    grid.height = {0.0, 1.0, 1.0, 5.0};
    t = make_terrain(grid, TerrainBorder::open);
    EXPECT_EQ(t.mesh.triangle[0].corner, (TriangleCorners{0, 1, 2}));
    grid.height = {0.0, 1.0, 1.0, 0.0};
    t = make_terrain(grid, TerrainBorder::open);
    EXPECT_EQ(t.mesh.triangle[0].corner, (TriangleCorners{0, 1, 3}));
    grid.height = {0.0, 1.0, 2.0, 1.0};  // they differ alike, but for round-off
    grid.height[3] += 1e-12;
    t = make_terrain(grid, TerrainBorder::open);
    EXPECT_EQ(t.mesh.triangle[0].corner, (TriangleCorners{0, 1, 3}));
}

TEST(Terrain, SidesCloseTheBorder) {
    for (const TerrainBorder border : {TerrainBorder::open, TerrainBorder::closed}) {
        const Terrain t = make_terrain(noisy_grid(7, 0.5, 0.3, 3), border);
        EXPECT_EQ(t.ground, 72U);
        EXPECT_EQ(t.mesh.triangle.size(), 72U + 2 * 24);
        EXPECT_EQ(open_edges(t), 24U);  // where the sides end
        EXPECT_NEAR(ground_area(t), 9.0, 1e-12);
        EXPECT_NEAR(t.bottom, t.lower.z() - 3.0, 1e-12);
        EXPECT_NEAR(t.top, t.upper.z() + 3.0, 1e-12);
        for (std::uint32_t i = t.ground; i < t.mesh.triangle.size(); ++i) {
            const auto& side = t.mesh.triangle[i];
            Vec3 outward = t.mesh.vertex[side.corner[0]];
            outward.z() = 0.0;
            EXPECT_EQ(side.normal.z(), 0.0);
            EXPECT_EQ(side.normal.dot(outward) > 0.0, border == TerrainBorder::open);
        }
    }
}

TEST(Terrain, HolesOfAnyShape) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        HeightGrid grid = noisy_grid(9, 1.0, 0.5, seed);
        Random random(seed, 2, 0);
        for (double& z : grid.height)
            if (random.uniform() < 0.3) z = kNoData;
        const Terrain t = make_terrain(grid, TerrainBorder::open);
        double area = 0.0;
        for (std::uint32_t j = 0; j + 1 < grid.rows; ++j)
            for (std::uint32_t i = 0; i + 1 < grid.columns; ++i) {
                const int nodes = grid.has(i, j) + grid.has(i + 1, j) + grid.has(i, j + 1) + grid.has(i + 1, j + 1);
                area += nodes == 4 ? 1.0 : nodes == 3 ? 0.5 : 0.0;
            }
        ASSERT_NEAR(ground_area(t), area, 1e-12);
        // the sides close every border: only their ends are open, one edge an edge of the border
        ASSERT_EQ(2 * open_edges(t), t.mesh.triangle.size() - t.ground) << seed;
        expect_whole_visits(t, seed, 4.0);
    }
}

TEST(Terrain, VisitsAgainstAWalkOverAll) {
    expect_whole_visits(make_terrain(noisy_grid(30, 0.2, 0.5, 1), TerrainBorder::open), 11, 2.0);
    expect_whole_visits(make_terrain(noisy_grid(30, 0.2, 0.5, 1), TerrainBorder::closed), 12, 2.0);
    // a mesh with triangles of very different sizes
    std::vector<Vec3> vertices;
    std::vector<TriangleCorners> triangles;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        Random random(5, 3, i);
        const double size = std::pow(10.0, random.uniform(-3.0, 0.0));
        const Vec3 at(random.uniform(0.0, 10.0), random.uniform(0.0, 10.0), random.uniform(0.0, 1.0));
        for (int k = 0; k < 3; ++k) {
            vertices.push_back(at + size * Vec3(random.uniform(), random.uniform(), random.uniform(-0.3, 0.3)));
        }
        const auto n = static_cast<std::uint32_t>(vertices.size());
        triangles.push_back({n - 3, n - 2, n - 1});
    }
    expect_whole_visits(make_terrain(vertices, triangles, TerrainBorder::open), 13, 4.0);
}

TEST(Terrain, TheColumnOfAPlace) {
    HeightGrid grid = noisy_grid(12, 0.5, 0.4, 9);
    grid.height[5 * 12 + 6] = kNoData;
    const Terrain t = make_terrain(grid, TerrainBorder::open);
    int none = 0;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        Random random(17, 1, i);
        const double x = random.uniform(-3.0, 3.0), y = random.uniform(-3.0, 3.0);
        std::optional<std::uint32_t> slow;
        for (std::uint32_t k = 0; k < t.ground; ++k) {
            const auto& c = t.mesh.triangle[k].corner;
            bool in = true;
            for (std::size_t e = 0; e < 3; ++e) {
                const Vec3 &p = t.mesh.vertex[c[e]], &q = t.mesh.vertex[c[(e + 1) % 3]];
                in = in && (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x()) >= 0.0;
            }
            if (in) slow = k;
        }
        ASSERT_EQ(t.column(x, y), slow);
        none += slow ? 0 : 1;
        if (!slow) continue;
        const auto& tri = t.mesh.triangle[*slow];
        const Vec3& p = t.mesh.vertex[tri.corner[0]];
        const double z = p.z() - (tri.normal.x() * (x - p.x()) + tri.normal.y() * (y - p.y())) / tri.normal.z();
        EXPECT_TRUE(t.under({x, y, z - 1e-9}));
        EXPECT_FALSE(t.under({x, y, z + 1e-9}));
        EXPECT_TRUE(t.under({x, y, t.bottom + 1e-6}));
        EXPECT_FALSE(t.under({x, y, t.bottom - 1e-6}));
    }
    EXPECT_GT(none, 400);  // beside the grid, and over the hole
}

TEST(Terrain, MovedAsAWhole) {
    const Vec3 shift(5e6, -3e6, 2000.0);
    const Terrain t = make_terrain(noisy_grid(6, 0.5, 0.3, 4), TerrainBorder::closed);
    const Terrain m = translated(t, shift);
    EXPECT_EQ(m.mesh.triangle.size(), t.mesh.triangle.size());
    for (std::size_t i = 0; i < t.mesh.vertex.size(); ++i) {
        EXPECT_LT((m.mesh.vertex[i] - t.mesh.vertex[i] - shift).norm(), 1e-8);
    }
    EXPECT_TRUE(m.under(shift + Vec3(0.1, 0.1, -0.1)));
    EXPECT_FALSE(m.under(shift + Vec3(0.1, 0.1, 0.5)));
    expect_whole_visits(m, 14, 4.0);
}

TEST(Terrain, NothingToStandOn) {
    HeightGrid grid = flat_grid(3, 1.0);
    grid.height[4] = kNoData;
    EXPECT_EQ(make_terrain(grid, TerrainBorder::open).ground, 4U);
    for (double& z : grid.height) z = kNoData;
    EXPECT_THROW(make_terrain(grid, TerrainBorder::open), ScenarioError);
    EXPECT_THROW(make_terrain({}, {}, TerrainBorder::open), ScenarioError);
}

}  // namespace
}  // namespace scree
