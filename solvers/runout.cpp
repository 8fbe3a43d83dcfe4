#include "solvers/runout.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/exact_sum.hpp"
#include "core/parallel/body_sums.hpp"
#include "core/parallel/sorted_slices.hpp"
#include "solvers/rasters.hpp"

namespace scree::solvers {
namespace {

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

// Of the numbers that ranks offer for the largest `value`, the smallest; kNone if there is none. Collective.
std::uint64_t first_with_most(double value, std::uint64_t number, double& most, const Communicator& ranks) {
    most = ranks.max(value);
    return ~ranks.max(value == most ? ~number : 0U);
}

}  // namespace

BodiesTogether together(const Scene& scene, const Bodies& bodies, const RasterGrid* grid, const Communicator& ranks) {
    const auto counts = [grid](const Vec3& x) {
        return grid == nullptr || (x.x() >= grid->x && x.x() < grid->x + grid->columns * grid->dx && x.y() >= grid->y &&
                                   x.y() < grid->y + grid->rows * grid->dy);
    };
    std::array<ExactSum, 5> sums;
    add_over_bodies(bodies, std::span<ExactSum, 5>(sums), [&](std::size_t i) {
        const double mass = counts(bodies.position[i]) ? bodies.mass[i] : 0.0;
        const Vec3 moment = mass * bodies.position[i];
        return std::array{mass / scene.materials[raw(bodies.material[i])].density, mass, moment.x(), moment.y(),
                          moment.z()};
    });
    ranks.sum(std::span<ExactSum>(sums));
    BodiesTogether all{sums[0].value(), sums[1].value(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN())};
    if (all.mass > 0.0) all.centre = Vec3(sums[2].value(), sums[3].value(), sums[4].value()) / all.mass;
    return all;
}

Vec3 highest_of_all(const State& state, const Communicator& ranks) {
    double highest = -std::numeric_limits<double>::infinity(), most = 0.0;
    std::uint64_t id = kNone;
    Vec3 place = Vec3::Zero();
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.is_ghost(i)) continue;
        const double z = highest_point(state, i);
        if (z <= highest) continue;
        highest = z;
        id = raw(state.bodies.id[i]);
        place = Vec3(state.bodies.position[i].x(), state.bodies.position[i].y(), z);
    }
    const std::uint64_t first = first_with_most(highest, id, most, ranks);
    if (first == kNone) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    const bool here = first == id;
    // One rank has it; the others add zeros.
    std::array<std::uint64_t, 3> bits{};
    for (int k = 0; here && k < 3; ++k) bits[static_cast<std::size_t>(k)] = std::bit_cast<std::uint64_t>(place[k]);
    ranks.sum(std::span<std::uint64_t>(bits));
    return {std::bit_cast<double>(bits[0]), std::bit_cast<double>(bits[1]), std::bit_cast<double>(bits[2])};
}

Runout runout(const Scene& scene, const State& state, const std::vector<double>& deposit, const Communicator& ranks) {
    const RasterSettings& settings = *scene.rasters;
    const RasterGrid& grid = settings.grid;
    const RasterState& rasters = state.rasters;
    const double area = grid.dx * grid.dy;
    const std::uint64_t first = Division{grid.rows, 1, ranks.size()}.first(ranks.rank()) * grid.columns;
    Runout out;
    double farthest = -1.0, most = 0.0;
    std::uint64_t toe = kNone;
    std::array<std::uint64_t, 2> count{};  // cells with deposit, with an arrival
    ExactSum depth;
    for (std::size_t c = 0; c < deposit.size(); ++c) {
        count[1] += rasters.arrival[c] < RasterState::kNever ? 1 : 0;
        if (!(deposit[c] > settings.covered)) continue;
        ++count[0];
        depth.add(deposit[c]);
        out.deposit_most = std::max(out.deposit_most, deposit[c]);
        const double x = grid.centre_x(first + c) - rasters.top.x(), y = grid.centre_y(first + c) - rasters.top.y();
        if (!(x * x + y * y > farthest)) continue;
        farthest = x * x + y * y;
        toe = first + c;
    }
    toe = first_with_most(farthest, toe, most, ranks);
    ranks.sum(std::span<std::uint64_t>(count));
    out.deposit_area = static_cast<double>(count[0]) * area;
    out.flowed_area = static_cast<double>(count[1]) * area;
    out.deposit_volume = ranks.sum(depth) * area;
    out.deposit_most = ranks.max(out.deposit_most);
    const BodiesTogether end = together(scene, state.bodies, &grid, ranks);
    out.beyond = together(scene, state.bodies, nullptr, ranks).volume - end.volume;
    out.released_volume = rasters.volume;
    out.top = rasters.top + scene.origin;
    out.centre_before = rasters.centre + scene.origin;
    out.centre_after = end.centre + scene.origin;
    const Vec3 centre = end.centre - rasters.centre;
    out.centre_fall = -centre.z();
    out.centre_length = std::hypot(centre.x(), centre.y());
    out.toe = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    out.fall_height = out.length = std::numeric_limits<double>::quiet_NaN();
    if (toe == kNone) return out;
    const double x = grid.centre_x(toe), y = grid.centre_y(toe);
    const Vec3 at(x, y, ground_height(scene, settings, x, y));
    out.toe = at + scene.origin;
    out.length = std::sqrt(most);
    out.fall_height = rasters.top.z() - at.z();
    return out;
}

}  // namespace scree::solvers
