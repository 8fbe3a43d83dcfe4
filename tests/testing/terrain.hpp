// Terrains for tests: a grid of squares cut in two, with heights from a function.
#pragma once

#include <functional>

#include "core/terrain_mesh.hpp"

namespace scree::testing {

inline TerrainMesh grid_terrain(int n, double spacing, const std::function<double(double, double)>& height) {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            const double x = spacing * (i - 0.5 * n), y = spacing * (j - 0.5 * n);
            vertices.push_back({x, y, height(x, y)});
        }
    }
    const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            if ((i + j) % 2 == 0) {  // the cut goes either way
                triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            } else {
                triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
                triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
            }
        }
    }
    return make_terrain_mesh(vertices, triangles);
}

}  // namespace scree::testing
