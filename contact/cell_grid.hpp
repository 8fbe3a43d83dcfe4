// Finds all pairs of overlapping spheres among n spheres of any sizes, in O(n) for any ratio of sizes: each sphere
// lives in a grid whose cells are at least as wide as its diameter (one grid a power of two), and looks for partners in
// its own grid and in the coarser ones (Ogarko and Luding 2012 describe the idea).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/vec.hpp"

namespace scree::contact {

struct Ball {
    double x, y, z, radius;  // [m]
};

class CellGrid {
  public:
    // Appends to `pairs` every (i, j), i < j, with |x_i - x_j| <= radius_i + radius_j, in no particular order.
    void find_pairs(const std::vector<Ball>& balls, std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);
    std::size_t bytes() const;

  private:
    struct Cell {
        std::int64_t x, y, z;
        std::uint32_t begin, end;  // into members of its level
    };
    struct Level {
        double width = 0.0;
        std::vector<std::uint32_t> members;  // bodies, cell by cell
        std::vector<Cell> cells;
        std::vector<std::uint32_t> table;  // open addressing: cell index + 1, 0 empty
        std::uint64_t mask = 0;

        const Cell* find(std::int64_t x, std::int64_t y, std::int64_t z) const;
    };
    void fill_level(Level& level, const std::vector<Ball>& balls, std::vector<std::uint32_t>& bodies);
    static void pairs_within(const Level& level, const std::vector<Ball>& balls,
                             std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);
    static void pairs_between(const Level& fine, const Level& coarse, const std::vector<Ball>& balls,
                              std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);

    std::vector<Level> levels_;
    struct Keyed {
        std::int64_t x, y, z;
        std::uint32_t body;
    };
    std::vector<Keyed> keyed_;
};

}  // namespace scree::contact
