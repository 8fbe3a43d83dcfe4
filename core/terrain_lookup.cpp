#include "core/terrain_lookup.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace scree {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr double kRoundOff = 1e-9;           // of a cell: coordinates of nodes are rounded
constexpr double kMostCellsATriangle = 4.0;  // no more memory for cells than for triangles, however they are spread

struct Extent {
    Vec3 lower, upper;

    double width() const { return std::max(upper.x() - lower.x(), upper.y() - lower.y()); }
    Vec3 middle() const { return 0.5 * (lower + upper); }
};

Extent extent_of(const std::vector<Vec3>& vertex, const TriangleCorners& t) {
    return {vertex[t[0]].cwiseMin(vertex[t[1]]).cwiseMin(vertex[t[2]]),
            vertex[t[0]].cwiseMax(vertex[t[1]]).cwiseMax(vertex[t[2]])};
}

// Triangles of one level: their extents are within a factor of two.
TerrainLookup::Cells make_cells(const std::vector<Extent>& extents, const std::vector<std::uint32_t>& members) {
    TerrainLookup::Cells c;
    Vec3 lower = extents[members.front()].middle(), upper = lower;
    double wide_x = 0.0, wide_y = 0.0;
    for (const std::uint32_t t : members) {
        const Extent& e = extents[t];
        lower = lower.cwiseMin(e.middle()), upper = upper.cwiseMax(e.middle());
        wide_x = std::max(wide_x, e.upper.x() - e.lower.x()), wide_y = std::max(wide_y, e.upper.y() - e.lower.y());
    }
    double width = std::max(wide_x, wide_y);
    const Vec3 size = upper - lower;
    const auto cells = [&] { return (size.x() / width + 1.0) * (size.y() / width + 1.0); };
    while (cells() > kMostCellsATriangle * static_cast<double>(members.size()) + 16.0) width *= 1.25;
    c.dx = c.dy = width;
    c.x = lower.x(), c.y = lower.y();
    c.nx = static_cast<std::uint32_t>(size.x() / width) + 1, c.ny = static_cast<std::uint32_t>(size.y() / width) + 1;
    c.reach_x = 0.5 * wide_x + kRoundOff * width, c.reach_y = 0.5 * wide_y + kRoundOff * width;
    return c;
}

std::size_t cell_of(const TerrainLookup::Cells& c, const Vec3& x) {
    const auto along = [](double p, double first, double width, std::uint32_t n) {
        return std::min(static_cast<std::uint32_t>(std::max((p - first) / width, 0.0)), n - 1);
    };
    return std::size_t{along(x.y(), c.y, c.dy, c.ny)} * c.nx + along(x.x(), c.x, c.dx, c.nx);
}

}  // namespace

void bound_heights(const std::vector<Vec3>& vertex, const std::vector<TriangleCorners>& triangle,
                   TerrainLookup::Cells& c) {
    c.z.assign(c.begin.size() - 1, {kFar, -kFar});
    for (std::size_t cell = 0; cell < c.z.size(); ++cell) {
        for (std::uint32_t t = c.begin[cell]; t < c.begin[cell + 1]; ++t) {
            const Extent e = extent_of(vertex, triangle[t]);
            const auto low = static_cast<float>(e.lower.z()), high = static_cast<float>(e.upper.z());
            c.z[cell][0] = std::min(c.z[cell][0], std::nextafter(low, -kFar));
            c.z[cell][1] = std::max(c.z[cell][1], std::nextafter(high, kFar));
        }
    }
}

void arrange_triangles(const std::vector<Vec3>& vertex, std::vector<TriangleCorners>& triangle, std::uint32_t fixed,
                       TerrainLookup& lookup) {
    const auto n = static_cast<std::uint32_t>(triangle.size());
    std::vector<Extent> extents(n);
    std::map<int, std::vector<std::uint32_t>> by_size;
    for (std::uint32_t t = fixed; t < n; ++t) {
        extents[t] = extent_of(vertex, triangle[t]);
        int exponent = 0;
        std::frexp(extents[t].width(), &exponent);
        by_size[exponent].push_back(t);
    }
    std::vector<TriangleCorners> arranged(triangle.begin(), triangle.begin() + fixed);
    for (const auto& [exponent, members] : by_size) {
        TerrainLookup::Cells c = make_cells(extents, members);
        std::vector<std::vector<std::uint32_t>> held(std::size_t{c.nx} * c.ny);
        for (const std::uint32_t t : members) held[cell_of(c, extents[t].middle())].push_back(t);
        for (const auto& cell : held) {
            c.begin.push_back(static_cast<std::uint32_t>(arranged.size()));
            for (const std::uint32_t t : cell) arranged.push_back(triangle[t]);
        }
        c.begin.push_back(static_cast<std::uint32_t>(arranged.size()));
        lookup.level.push_back(std::move(c));
    }
    triangle.swap(arranged);
    for (TerrainLookup::Cells& c : lookup.level)
        if (c.z.empty()) bound_heights(vertex, triangle, c);
}

}  // namespace scree
