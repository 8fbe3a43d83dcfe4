#include "scenarios/shapes/voronoi.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scenarios/shapes/cut.hpp"

namespace scree::scenarios {
namespace {

constexpr double kThinnest = 1e-9, kClosest = 1e-6;  // of the size of the body

struct Neighbour {
    double distance;  // [m]
    std::size_t seed;

    bool operator<(const Neighbour& other) const {
        return distance != other.distance ? distance < other.distance : seed < other.seed;
    }
};

// Seeds in cells of equal boxes, about two in each; sought in shells of boxes around one of them.
class SeedGrid {
  public:
    SeedGrid(const std::vector<Vec3>& seeds, const Extent& extent) : seeds_(seeds), lower_(extent.lower) {
        const Vec3 sides = extent.upper - extent.lower;
        width_ = std::cbrt(2.0 * sides.prod() / static_cast<double>(seeds.size()));
        width_ = std::max(width_, sides.maxCoeff() / 1000.0);
        for (int i = 0; i < 3; ++i) cells_[i] = 1 + static_cast<int>(sides[i] / width_);
        members_.resize(static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) *
                        static_cast<std::size_t>(cells_[2]));
        for (std::size_t k = 0; k < seeds.size(); ++k) members_[place(cell_of(seeds[k]))].push_back(k);
    }

    // All seeds in boxes `shell` boxes away, nearest first.
    std::vector<Neighbour> shell(std::size_t seed, int shell) const {
        const auto centre = cell_of(seeds_[seed]);
        std::vector<Neighbour> found;
        std::array<int, 3> c{};
        for (c[0] = std::max(0, centre[0] - shell); c[0] <= std::min(cells_[0] - 1, centre[0] + shell); ++c[0])
            for (c[1] = std::max(0, centre[1] - shell); c[1] <= std::min(cells_[1] - 1, centre[1] + shell); ++c[1])
                for (c[2] = std::max(0, centre[2] - shell); c[2] <= std::min(cells_[2] - 1, centre[2] + shell);
                     ++c[2]) {
                    const int away =
                        std::max({std::abs(c[0] - centre[0]), std::abs(c[1] - centre[1]), std::abs(c[2] - centre[2])});
                    if (away != shell) continue;
                    for (const std::size_t k : members_[place(c)])
                        if (k != seed) found.push_back({(seeds_[k] - seeds_[seed]).norm(), k});
                }
        std::sort(found.begin(), found.end());
        return found;
    }
    // No seed in this shell or beyond is nearer [m].
    double nearest(int shell) const { return (shell - 1) * width_; }
    int shells() const { return std::max({cells_[0], cells_[1], cells_[2]}); }

  private:
    std::array<int, 3> cell_of(const Vec3& x) const {
        std::array<int, 3> c{};
        for (std::size_t i = 0; i < 3; ++i)
            c[i] = std::clamp(static_cast<int>((x[static_cast<int>(i)] - lower_[static_cast<int>(i)]) / width_), 0,
                              cells_[i] - 1);
        return c;
    }
    std::size_t place(const std::array<int, 3>& c) const {
        return (static_cast<std::size_t>(c[2]) * static_cast<std::size_t>(cells_[1]) + static_cast<std::size_t>(c[1])) *
                   static_cast<std::size_t>(cells_[0]) +
               static_cast<std::size_t>(c[0]);
    }

    const std::vector<Vec3>& seeds_;
    Vec3 lower_;
    double width_ = 0.0;  // [m]
    std::array<int, 3> cells_{};
    std::vector<std::vector<std::size_t>> members_;
};

double reach(const Polyhedron& cell, const Vec3& seed) {
    double farthest = 0.0;
    for (const Vec3& x : cell.vertex) farthest = std::max(farthest, (x - seed).norm());
    return farthest;
}

Polyhedron cell_of(const Polyhedron& body, const std::vector<Vec3>& seeds, std::size_t seed, const SeedGrid& grid,
                   double size) {
    Polyhedron cell = body;
    double farthest = reach(cell, seeds[seed]);
    for (int shell = 0; shell < grid.shells() && grid.nearest(shell) < 2.0 * farthest; ++shell)
        for (const Neighbour& other : grid.shell(seed, shell)) {
            if (other.distance >= 2.0 * farthest) break;
            if (other.distance < kClosest * size)
                throw ShapeError(ShapeFault::no_volume,
                                 fmt::format("seeds {} and {} are only {:g} m apart", std::min(seed, other.seed),
                                             std::max(seed, other.seed), other.distance));
            const Vec3 normal = (seeds[other.seed] - seeds[seed]) / other.distance;
            cell = cut_below(cell, {normal, normal.dot(0.5 * seeds[seed] + 0.5 * seeds[other.seed])}, kThinnest * size);
            farthest = reach(cell, seeds[seed]);
        }
    return cell;
}

void check_inside(const Polyhedron& body, const std::vector<Vec3>& seeds, double size) {
    for (std::size_t f = 0; f < body.face.size(); ++f) {
        const Vec3 normal = area_vector(body, f).normalized(), corner = body.vertex[body.face[f][0]];
        for (std::size_t k = 0; k < seeds.size(); ++k)
            if (!(normal.dot(seeds[k] - corner) <= kThinnest * size))
                throw ShapeError(ShapeFault::no_volume, fmt::format("seed {} lies outside of the body", k));
    }
}

}  // namespace

std::vector<Polyhedron> voronoi_cells(const Polyhedron& body, const std::vector<Vec3>& seeds) {
    if (seeds.empty()) return {};
    const Extent extent = extent_of(body.vertex);
    check_inside(body, seeds, extent.size());
    const SeedGrid grid(seeds, extent);
    std::vector<Polyhedron> cells;
    for (std::size_t k = 0; k < seeds.size(); ++k) cells.push_back(cell_of(body, seeds, k, grid, extent.size()));
    return cells;
}

}  // namespace scree::scenarios
