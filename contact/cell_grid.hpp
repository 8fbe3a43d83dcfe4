// Finds all pairs of overlapping spheres among n spheres of any sizes, in O(n) for any ratio of sizes: each sphere
// lives in a grid whose cells are at least as wide as its diameter (one grid a power of two), and looks for partners in
// its own grid and in the coarser ones (Ogarko and Luding 2012 describe the idea).
//
// A grid is a list of its filled cells sorted by (z, y, x): the three neighbours in a row are next to each other, and
// walking all cells in order walks each neighbouring row in order too. No table of cells, so no limit of extent.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/vec.hpp"

namespace scree::contact {

struct Ball {
    double x, y, z, radius;  // [m]
};
inline bool overlap(const Ball& a, const Ball& b) {
    const double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
    const double reach = a.radius + b.radius;
    return dx * dx + dy * dy + dz * dz <= reach * reach;
}
using BodyPair = std::pair<std::uint32_t, std::uint32_t>;

class CellGrid {
  public:
    // Appends to `pairs` every (i, j), i < j, with |x_i - x_j| <= radius_i + radius_j, in no particular order.
    void find_pairs(const std::vector<Ball>& balls, std::vector<BodyPair>& pairs);

    // The balls stay in the grid until find_pairs() is called again. One that moved is taken out, and its partners
    // among those still there are looked for: appends pairs of `body` with them.
    bool holds(std::uint32_t body) const { return body < place_.size() && place_[body].level != kNowhere; }
    void take_out(std::uint32_t body);
    void find_partners(std::uint32_t body, const Ball& ball, std::vector<BodyPair>& pairs) const;
    // Body i is called `name[i]` from now on, of `count` names; kGone: it is taken out.
    static constexpr std::uint32_t kGone = 0xffffffff;
    void rename(const std::vector<std::uint32_t>& name, std::size_t count);
    std::size_t bytes() const;

  private:
    struct Level {
        double width = 0.0;                // of a cell [m]
        double lower[3] = {};              // corner of the grid [m]
        int bits[3] = {};                  // of the index in each direction, one cell of margin on both sides
        std::vector<std::uint64_t> key;    // one a filled cell, increasing
        std::vector<std::uint32_t> begin;  // cells + 1, into ball and body
        // Cell by cell; the radius of a ball taken out is NaN, so that nothing overlaps it. Room for a pack of eight
        // that starts at the last one.
        std::vector<double> x, y, z, radius;
        std::vector<std::uint32_t> body;

        Ball ball(std::uint32_t m) const { return {x[m], y[m], z[m], radius[m]}; }
        std::uint64_t pack(std::int64_t i, std::int64_t j, std::int64_t k) const;
        std::int64_t index(double at, int direction) const;
    };
    struct Keyed {
        std::uint64_t key;
        std::uint32_t body;
    };
    void fill(Level& level, const std::vector<Ball>& balls, const std::vector<std::uint32_t>& bodies);
    static constexpr std::uint32_t kNowhere = 0xffffffff;
    struct Place {
        std::uint32_t level = kNowhere, index = 0;
    };
    class Search;
    static void pairs_within(const Level& level, std::vector<BodyPair>& pairs);
    static void pairs_between(const Level& fine, const Level& coarse, std::vector<BodyPair>& pairs);
    static void find_in(const Level& level, std::uint32_t body, const Ball& ball, std::vector<BodyPair>& pairs);

    std::vector<Level> levels_;
    std::vector<Place> place_;  // one a body
    std::vector<Keyed> keyed_, scratch_;
};

}  // namespace scree::contact
