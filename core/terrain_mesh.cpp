#include "core/terrain_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/errors.hpp"

namespace scree {
namespace {

constexpr double kFlat = 1e-9;  // sine: less of a ridge is none

struct HalfEdge {
    std::uint32_t low, high, triangle, corner;
    bool forward;  // from the lower vertex to the higher one

    bool operator<(const HalfEdge& other) const {
        return low != other.low ? low < other.low : high != other.high ? high < other.high : forward > other.forward;
    }
};

[[noreturn]] void refuse(std::uint32_t triangle, const std::string& why) {
    throw ScenarioError("triangle " + std::to_string(triangle) + ": " + why);
}

double angle_at(const std::vector<Vec3>& vertex, const std::array<std::uint32_t, 3>& corner, std::uint32_t i) {
    const Vec3 p = vertex[corner[(i + 1) % 3]] - vertex[corner[i]], q = vertex[corner[(i + 2) % 3]] - vertex[corner[i]];
    return std::atan2(p.cross(q).norm(), p.dot(q));
}

void add_edge(TerrainMesh& mesh, const HalfEdge* half, std::size_t sides) {
    const auto index = static_cast<std::uint32_t>(mesh.edge.size());
    TerrainMesh::Edge edge{half[0].low,  half[0].high, TerrainMesh::kNone, TerrainMesh::kNone, Vec3::Zero(),
                           Vec3::Zero(), true};
    const Vec3 along = mesh.vertex[edge.to] - mesh.vertex[edge.from];
    for (std::size_t i = 0; i < sides; ++i) {
        const std::uint32_t t = half[i].triangle;
        (half[i].forward ? edge.left : edge.right) = t;
        const Vec3 into = mesh.triangle[t].normal.cross(along).normalized();
        if (half[i].forward) edge.into_left = into;
        if (!half[i].forward) edge.into_right = -into;
        mesh.triangle[t].edge[half[i].corner] = index;
    }
    if (sides == 2) edge.convex = mesh.triangle[edge.left].normal.dot(edge.into_right) < -kFlat;
    if (edge.convex) mesh.on_ridge[edge.from] = mesh.on_ridge[edge.to] = 1;
    mesh.edge.push_back(edge);
}

void link_vertices(TerrainMesh& mesh) {
    std::vector<std::vector<std::uint32_t>> links(mesh.vertex.size());
    for (const TerrainMesh::Edge& e : mesh.edge) {
        links[e.from].push_back(e.to);
        links[e.to].push_back(e.from);
    }
    for (std::vector<std::uint32_t>& l : links) {
        std::sort(l.begin(), l.end());
        mesh.link_begin.push_back(static_cast<std::uint32_t>(mesh.link.size()));
        mesh.link.insert(mesh.link.end(), l.begin(), l.end());
    }
    mesh.link_begin.push_back(static_cast<std::uint32_t>(mesh.link.size()));
}

}  // namespace

TerrainMesh make_terrain_mesh(std::vector<Vec3> vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    TerrainMesh mesh;
    mesh.vertex = std::move(vertices);
    mesh.owner.assign(mesh.vertex.size(), TerrainMesh::kNone);
    mesh.on_ridge.assign(mesh.vertex.size(), 0);
    mesh.outward.assign(mesh.vertex.size(), Vec3::Zero());
    std::vector<HalfEdge> half;
    half.reserve(3 * triangles.size());
    mesh.triangle.reserve(triangles.size());
    mesh.edge.reserve(2 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const std::array<std::uint32_t, 3>& c = triangles[t];
        if (*std::max_element(c.begin(), c.end()) >= mesh.vertex.size()) refuse(t, "a corner is not there");
        const Vec3 p = mesh.vertex[c[1]] - mesh.vertex[c[0]], q = mesh.vertex[c[2]] - mesh.vertex[c[0]];
        const Vec3 across = p.cross(q);
        if (!(across.norm() > 1e-12 * std::max(p.squaredNorm(), q.squaredNorm()))) refuse(t, "it has no area");
        mesh.triangle.push_back({c, {0, 0, 0}, across.normalized()});
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t from = c[i], to = c[(i + 1) % 3];
            half.push_back({std::min(from, to), std::max(from, to), t, i, from < to});
            if (mesh.owner[from] == TerrainMesh::kNone) mesh.owner[from] = t;
            mesh.outward[from] += angle_at(mesh.vertex, c, i) * mesh.triangle[t].normal;
        }
    }
    std::sort(half.begin(), half.end());
    for (std::size_t i = 0; i < half.size();) {
        const bool pair = i + 1 < half.size() && half[i + 1].low == half[i].low && half[i + 1].high == half[i].high;
        if (pair && half[i].forward == half[i + 1].forward) {
            refuse(std::max(half[i].triangle, half[i + 1].triangle), "another one has an edge in the same direction");
        }
        add_edge(mesh, &half[i], pair ? 2 : 1);
        i += pair ? 2 : 1;
        if (pair && i < half.size() && half[i].low == half[i - 1].low && half[i].high == half[i - 1].high) {
            refuse(half[i].triangle, "another one has an edge in the same direction");
        }
    }
    mesh.edge.shrink_to_fit();
    link_vertices(mesh);
    mesh.vertex.shrink_to_fit(), mesh.link.shrink_to_fit(), mesh.link_begin.shrink_to_fit();
    return mesh;
}

}  // namespace scree
