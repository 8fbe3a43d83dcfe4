#include "core/terrain_sides.hpp"

#include <algorithm>
#include <numeric>

#include "core/terrain_mesh.hpp"

namespace scree {
namespace {

struct HalfEdge {
    std::uint32_t low, high;  // vertices
    std::uint32_t from;       // corner 3 t + i of triangle t at which it begins

    bool operator<(const HalfEdge& other) const {
        return low != other.low ? low < other.low : high != other.high ? high < other.high : from < other.from;
    }
    bool meets(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

constexpr std::uint32_t next_corner(std::uint32_t c) {
    return c % 3 == 2 ? c - 2 : c + 1;
}

std::uint32_t vertex_at(const std::vector<TriangleCorners>& triangle, std::uint32_t corner) {
    return triangle[corner / 3][corner % 3];
}

// Sorted: the two halves of an inner edge lie side by side.
std::vector<HalfEdge> half_edges(const std::vector<TriangleCorners>& triangle) {
    std::vector<HalfEdge> half;
    half.reserve(3 * triangle.size());
    for (std::uint32_t c = 0; c < 3 * triangle.size(); ++c) {
        const std::uint32_t a = vertex_at(triangle, c), b = vertex_at(triangle, next_corner(c));
        half.push_back({std::min(a, b), std::max(a, b), c});
    }
    std::sort(half.begin(), half.end());
    return half;
}

// Sets of corners, each named by its first.
struct Sets {
    std::vector<std::uint32_t> parent;

    explicit Sets(std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0U); }
    std::uint32_t find(std::uint32_t c) {
        while (parent[c] != c) c = parent[c] = parent[parent[c]];
        return c;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        parent[std::max(a, b)] = std::min(a, b);
    }
};

}  // namespace

void split_pinches(std::vector<Vec3>& vertex, std::vector<TriangleCorners>& triangle) {
    const std::vector<HalfEdge> half = half_edges(triangle);
    Sets sets(3 * triangle.size());
    for (std::size_t i = 0; i + 1 < half.size(); ++i) {
        if (!half[i].meets(half[i + 1])) continue;
        const std::uint32_t a = half[i].from, b = half[i + 1].from;
        const bool alike = vertex_at(triangle, a) == vertex_at(triangle, b);
        sets.join(a, alike ? b : next_corner(b));
        sets.join(next_corner(a), alike ? next_corner(b) : b);
    }
    std::vector<std::uint32_t> part(vertex.size(), TerrainMesh::kNone);  // the set that keeps the vertex
    std::vector<std::uint32_t> other(3 * triangle.size(), TerrainMesh::kNone);
    for (std::uint32_t c = 0; c < 3 * triangle.size(); ++c) {
        const std::uint32_t set = sets.find(c);
        std::uint32_t& v = triangle[c / 3][c % 3];
        if (part[v] == TerrainMesh::kNone) part[v] = set;
        if (part[v] == set) continue;
        if (other[set] == TerrainMesh::kNone) {
            other[set] = static_cast<std::uint32_t>(vertex.size());
            vertex.push_back(Vec3(vertex[v]));
        }
        v = other[set];
    }
}

void add_sides(std::vector<Vec3>& vertex, std::vector<TriangleCorners>& triangle, double z) {
    const std::vector<HalfEdge> half = half_edges(triangle);
    std::vector<std::uint32_t> border;  // corners, increasing
    for (std::size_t i = 0; i < half.size(); ++i) {
        const bool first = i + 1 < half.size() && half[i].meets(half[i + 1]);
        if (first)
            ++i;
        else
            border.push_back(half[i].from);
    }
    std::sort(border.begin(), border.end());
    std::vector<std::uint32_t> end(vertex.size(), TerrainMesh::kNone);  // the vertex below or above each
    const auto end_of = [&](std::uint32_t v) {
        if (end[v] == TerrainMesh::kNone) {
            end[v] = static_cast<std::uint32_t>(vertex.size());
            vertex.emplace_back(vertex[v].x(), vertex[v].y(), z);
        }
        return end[v];
    };
    for (const std::uint32_t c : border) {
        const std::uint32_t a = vertex_at(triangle, c), b = vertex_at(triangle, next_corner(c));
        const Vec3 along = vertex[b] - vertex[a];
        if (along.head<2>().norm() <= 1e-9 * along.norm()) continue;  // upright itself
        const std::uint32_t a_end = end_of(a), b_end = end_of(b);
        triangle.push_back({b, a, a_end});
        triangle.push_back({b, a_end, b_end});
    }
}

}  // namespace scree
