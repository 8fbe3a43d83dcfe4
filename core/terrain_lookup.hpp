// Which triangles of a terrain may touch a box: rectangular cells over x and y, in levels by the triangles' size.
//
// A triangle belongs to one cell alone, and sticks out of it by no more than its level's `reach`; the triangles are
// numbered by level and cell, so that a look at neighbouring cells meets each once, in increasing order, without a list
// of its own. A cell knows the heights of its triangles: one high above them is done with in a few cells.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/vec.hpp"

namespace scree {

struct TerrainLookup {
    struct Cells {
        double x = 0.0, y = 0.0;              // [m] lower corner of the first cell
        double dx = 0.0, dy = 0.0;            // [m] size of a cell
        std::uint32_t nx = 0, ny = 0;         // cells along x, y
        double reach_x = 0.0, reach_y = 0.0;  // [m] how far triangles stick out of their cell
        std::vector<std::uint32_t> begin;     // nx ny + 1: first triangle of each cell, x fastest
        std::vector<std::array<float, 2>> z;  // [m] nx ny: a bound below and above the cell's triangles
    };
    std::vector<Cells> level;

    // Calls visit(triangle) for each whose cell the box meets.
    template <class Visit>
    void visit(const Vec3& lower, const Vec3& upper, Visit&& call) const {
        for (const Cells& c : level) {
            const auto [i0, i1] = range(lower.x() - c.reach_x, upper.x() + c.reach_x, c.x, c.dx, c.nx);
            const auto [j0, j1] = range(lower.y() - c.reach_y, upper.y() + c.reach_y, c.y, c.dy, c.ny);
            for (std::uint32_t j = j0; j < j1; ++j)
                for (std::uint32_t i = i0; i < i1; ++i) {
                    const std::size_t cell = std::size_t{j} * c.nx + i;
                    if (c.z[cell][0] > upper.z() || c.z[cell][1] < lower.z()) continue;
                    for (std::uint32_t t = c.begin[cell]; t < c.begin[cell + 1]; ++t) call(t);
                }
        }
    }

    std::size_t bytes() const {
        std::size_t sum = 0;
        for (const Cells& c : level) sum += c.begin.capacity() * 4 + c.z.capacity() * 8;
        return sum;
    }

  private:
    // Cells that [low, high] meets, as a half-open range.
    static std::array<std::uint32_t, 2> range(double low, double high, double first, double width, std::uint32_t n) {
        const double a = std::floor((low - first) / width), b = std::floor((high - first) / width);
        if (!(b >= 0.0) || !(a < n)) return {0, 0};
        return {a > 0.0 ? static_cast<std::uint32_t>(a) : 0U, b < n ? static_cast<std::uint32_t>(b) + 1U : n};
    }
};

using TriangleCorners = std::array<std::uint32_t, 3>;

// Puts `triangle` into the order of the cells, and makes these. The triangles from `fixed` on are arranged; those
// before it are in levels that are there already.
void arrange_triangles(const std::vector<Vec3>& vertex, std::vector<TriangleCorners>& triangle, std::uint32_t fixed,
                       TerrainLookup& lookup);
// Bounds of the heights of the triangles of each cell of a level whose `begin` is made.
void bound_heights(const std::vector<Vec3>& vertex, const std::vector<TriangleCorners>& triangle,
                   TerrainLookup::Cells& cells);

}  // namespace scree
