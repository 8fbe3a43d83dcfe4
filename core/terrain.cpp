#include "core/terrain.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/terrain_sides.hpp"

namespace scree {
namespace {

constexpr double kAlike = 1e-9;                                   // of a cell: such differences of height are round-off
constexpr double kRoundOff = 1e-9;                                // of a cell: coordinates of nodes are rounded
constexpr double kMostFeatures = static_cast<double>(1U << 30U);  // edges are the most

constexpr std::uint32_t kNone = TerrainMesh::kNone;

// The vertices of a grid's nodes, and its triangles cell by cell.
struct GridTriangles {
    std::vector<Vec3> vertex;
    std::vector<TriangleCorners> triangle;
    TerrainLookup::Cells cells;
};

// Corners of a cell counter-clockwise from the lowest x and y; its triangles, of which those without data are left out.
void cut_cell(const HeightGrid& grid, const std::vector<std::uint32_t>& at, std::uint32_t i, std::uint32_t j,
              std::vector<TriangleCorners>& out) {
    const std::size_t below = std::size_t{j} * grid.columns + i, above = below + grid.columns;
    const std::array<std::size_t, 4> node = {below, below + 1, above + 1, above};
    std::array<std::uint32_t, 4> v{};
    for (std::size_t k = 0; k < 4; ++k) v[k] = at[node[k]];
    const auto missing = static_cast<std::size_t>(std::count(v.begin(), v.end(), kNone));
    if (missing > 1) return;
    if (missing == 1) {
        const auto k = static_cast<std::size_t>(std::find(v.begin(), v.end(), kNone) - v.begin());
        out.push_back({v[(k + 1) % 4], v[(k + 2) % 4], v[(k + 3) % 4]});
        return;
    }
    const double rising = std::abs(grid.height[node[0]] - grid.height[node[2]]),
                 falling = std::abs(grid.height[node[1]] - grid.height[node[3]]);
    if (rising <= falling + kAlike * (grid.dx + grid.dy)) {
        out.push_back({v[0], v[1], v[2]});
        out.push_back({v[0], v[2], v[3]});
    } else {
        out.push_back({v[0], v[1], v[3]});
        out.push_back({v[1], v[2], v[3]});
    }
}

GridTriangles cut(const HeightGrid& grid) {
    GridTriangles result;
    std::vector<std::uint32_t> at(grid.height.size(), kNone);
    for (std::uint32_t j = 0; j < grid.rows; ++j)
        for (std::uint32_t i = 0; i < grid.columns; ++i) {
            if (!grid.has(i, j)) continue;
            at[std::size_t{j} * grid.columns + i] = static_cast<std::uint32_t>(result.vertex.size());
            result.vertex.emplace_back(grid.x + i * grid.dx, grid.y + j * grid.dy, grid.at(i, j));
        }
    TerrainLookup::Cells& c = result.cells;
    c.x = grid.x, c.y = grid.y, c.dx = grid.dx, c.dy = grid.dy;
    c.nx = grid.columns - 1, c.ny = grid.rows - 1;
    c.reach_x = kRoundOff * grid.dx, c.reach_y = kRoundOff * grid.dy;
    for (std::uint32_t j = 0; j + 1 < grid.rows; ++j)
        for (std::uint32_t i = 0; i + 1 < grid.columns; ++i) {
            c.begin.push_back(static_cast<std::uint32_t>(result.triangle.size()));
            cut_cell(grid, at, i, j, result.triangle);
        }
    c.begin.push_back(static_cast<std::uint32_t>(result.triangle.size()));
    return result;
}

// The ground is there; its sides are added, and all is put into the lookup.
void finish(Terrain& terrain, std::vector<Vec3> vertex, std::vector<TriangleCorners> triangle, bool sides) {
    terrain.ground = static_cast<std::uint32_t>(triangle.size());
    if (triangle.empty()) throw ScenarioError("there is no triangle in it");
    terrain.lower = Vec3::Constant(std::numeric_limits<double>::infinity());
    terrain.upper = -terrain.lower;
    for (const TriangleCorners& t : triangle)
        for (const std::uint32_t v : t) {
            terrain.lower = terrain.lower.cwiseMin(vertex[v]);
            terrain.upper = terrain.upper.cwiseMax(vertex[v]);
        }
    const double width = (terrain.upper - terrain.lower).maxCoeff();
    terrain.bottom = terrain.lower.z() - width, terrain.top = terrain.upper.z() + width;
    if (sides) {
        add_sides(vertex, triangle, terrain.border == TerrainBorder::open ? terrain.bottom : terrain.top);
        arrange_triangles(vertex, triangle, terrain.ground, terrain.lookup);
    }
    if (3.0 * static_cast<double>(triangle.size()) > kMostFeatures) {
        throw ScenarioError("it has more triangles than one terrain can hold");
    }
    terrain.mesh = make_terrain_mesh(std::move(vertex), triangle);
}

bool in_rectangle(const HeightGrid& grid, double x, double y) {
    return x >= grid.x && x <= grid.last_x() && y >= grid.y && y <= grid.last_y();
}

// How far inside the triangle's outline a place lies, seen from above; negative beside it. [m2]
double inside(const TerrainMesh& mesh, std::uint32_t triangle, double x, double y) {
    const TriangleCorners& c = mesh.triangle[triangle].corner;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &p = mesh.vertex[c[k]], &q = mesh.vertex[c[(k + 1) % 3]];
        least = std::min(least, (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x()));
    }
    return least;
}

}  // namespace

std::optional<std::uint32_t> Terrain::column(double x, double y) const {
    if (!grid || !in_rectangle(*grid, x, y)) return std::nullopt;
    const TerrainLookup::Cells& c = lookup.level.front();
    const auto i = std::min(static_cast<std::uint32_t>((x - c.x) / c.dx), c.nx - 1),
               j = std::min(static_cast<std::uint32_t>((y - c.y) / c.dy), c.ny - 1);
    const std::size_t cell = std::size_t{j} * c.nx + i;
    const std::uint32_t first = c.begin[cell], count = c.begin[cell + 1] - first;
    if (count == 0) return std::nullopt;
    if (count == 2) return inside(mesh, first, x, y) >= 0.0 ? first : first + 1;
    // a cell with a hole: on its border is inside
    if (inside(mesh, first, x, y) < -kRoundOff * c.dx * c.dy) return std::nullopt;
    return first;
}

bool Terrain::under(const Vec3& x, std::optional<std::uint32_t> t) const {
    if (!t || (border == TerrainBorder::open && x.z() <= bottom)) return false;
    return mesh.triangle[*t].normal.dot(x - mesh.vertex[mesh.triangle[*t].corner[0]]) < 0.0;
}

bool Terrain::outside(const Vec3& x) const {
    return grid && border == TerrainBorder::closed && x.z() < top && !in_rectangle(*grid, x.x(), x.y());
}

std::size_t Terrain::bytes() const {
    return mesh.vertex.capacity() * sizeof(Vec3) + mesh.triangle.capacity() * sizeof(TerrainMesh::Triangle) +
           mesh.edge.capacity() * sizeof(TerrainMesh::Edge) +
           (mesh.link_begin.capacity() + mesh.link.capacity() + mesh.owner.capacity()) * 4 + mesh.on_ridge.capacity() +
           mesh.outward.capacity() * sizeof(Vec3) + lookup.bytes() + material.capacity() * sizeof(MaterialIndex) +
           (grid ? grid->height.capacity() * sizeof(double) : 0) +
           (release ? release->thickness.capacity() * sizeof(double) : 0);
}

Terrain make_terrain(HeightGrid grid, TerrainBorder border) {
    SCREE_CHECK(grid.columns >= 2 && grid.rows >= 2 && grid.dx > 0.0 && grid.dy > 0.0);
    SCREE_CHECK(grid.height.size() == std::size_t{grid.columns} * grid.rows);
    GridTriangles made = cut(grid);
    Terrain terrain;
    terrain.border = border;
    bound_heights(made.vertex, made.triangle, made.cells);
    terrain.lookup.level.push_back(std::move(made.cells));
    split_pinches(made.vertex, made.triangle);
    terrain.grid = std::move(grid);
    finish(terrain, std::move(made.vertex), std::move(made.triangle), true);
    return terrain;
}

Terrain make_terrain(std::vector<Vec3> vertices, std::vector<TriangleCorners> triangles, TerrainBorder border) {
    Terrain terrain;
    terrain.border = border;
    const TerrainMesh checked = make_terrain_mesh(vertices, triangles);
    const bool overhangs = std::any_of(checked.triangle.begin(), checked.triangle.end(),
                                       [](const TerrainMesh::Triangle& t) { return !(t.normal.z() > kAlike); });
    split_pinches(vertices, triangles);
    arrange_triangles(vertices, triangles, 0, terrain.lookup);
    finish(terrain, std::move(vertices), std::move(triangles), border == TerrainBorder::closed || !overhangs);
    return terrain;
}

Terrain translated(const Terrain& terrain, const Vec3& shift) {
    Terrain moved = terrain;
    for (Vec3& v : moved.mesh.vertex) v += shift;
    for (TerrainLookup::Cells& c : moved.lookup.level) {
        c.x += shift.x(), c.y += shift.y(), c.z.clear();
        std::vector<TriangleCorners> corners;
        for (const TerrainMesh::Triangle& t : moved.mesh.triangle) corners.push_back(t.corner);
        bound_heights(moved.mesh.vertex, corners, c);
    }
    moved.lower += shift, moved.upper += shift;
    moved.bottom += shift.z(), moved.top += shift.z();
    if (moved.grid) {
        moved.grid->x += shift.x(), moved.grid->y += shift.y();
        for (double& z : moved.grid->height) z += shift.z();
    }
    return moved;
}

}  // namespace scree
