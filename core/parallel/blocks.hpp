// Cubic blocks of edge L that cut space into pieces of work: block (i, j, k) holds the points with floor(x / L) = i,
// and so on. They order the work (solvers/layout.hpp) and are what ranks own.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/vec.hpp"

namespace scree {

using BlockIndex = std::array<std::int32_t, 3>;

inline constexpr std::int32_t kMostBlocks = 1 << 20;  // in one direction, on either side of the origin

// Far out, indices are held at the last block: that only puts things that are far apart into one block.
inline std::int32_t block_index(double x, double edge) {
    const double i = std::floor(x / edge), most = static_cast<double>(kMostBlocks);
    if (!(i > -most)) return -kMostBlocks;
    return i < most ? static_cast<std::int32_t>(i) : kMostBlocks;
}

inline BlockIndex block_of(const Vec3& x, double edge) {
    return {block_index(x.x(), edge), block_index(x.y(), edge), block_index(x.z(), edge)};
}

}  // namespace scree
