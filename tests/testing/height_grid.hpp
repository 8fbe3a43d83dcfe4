// Grids of heights for tests.
#pragma once

#include <functional>
#include <limits>

#include "core/random.hpp"
#include "core/terrain.hpp"
#include "core/wall.hpp"

namespace scree::testing {

inline constexpr double kNoData = std::numeric_limits<double>::quiet_NaN();

inline HeightGrid height_grid(std::uint32_t columns, std::uint32_t rows, double dx, double dy,
                              const std::function<double(double, double)>& height, double x = 0.0, double y = 0.0) {
    HeightGrid grid{columns, rows, x, y, dx, dy, {}};
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) grid.height.push_back(height(x + i * dx, y + j * dy));
    return grid;
}

inline HeightGrid flat_grid(std::uint32_t n, double spacing, double z = 0.0) {
    const double half = -0.5 * (n - 1) * spacing;
    return height_grid(
        n, n, spacing, spacing, [z](double, double) { return z; }, half, half);
}

// Heights at random between 0 and `rough`.
inline HeightGrid noisy_grid(std::uint32_t n, double spacing, double rough, std::uint64_t seed) {
    Random random(seed, 7, 7);
    const double half = -0.5 * (n - 1) * spacing;
    return height_grid(
        n, n, spacing, spacing, [&](double, double) { return random.uniform(0.0, rough); }, half, half);
}

inline WallShape wall_of(HeightGrid grid, TerrainBorder border = TerrainBorder::open) {
    return TerrainWall{std::make_shared<const Terrain>(make_terrain(std::move(grid), border))};
}

}  // namespace scree::testing
