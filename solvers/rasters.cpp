#include "solvers/rasters.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/parallel/sorted_slices.hpp"
#include "core/terrain.hpp"
#include "solvers/runout.hpp"

namespace scree::solvers {
namespace {

constexpr int kUnitBits = 40;

// Cells that [low, high] meets and the share of its length in each.
struct Overlap {
    std::int64_t first = 0, last = -1;
    double low, high, origin, width;

    Overlap(double centre, double side, double grid_origin, double cell, std::uint32_t count)
        : low(centre - 0.5 * side), high(centre + 0.5 * side), origin(grid_origin), width(cell) {
        const double a = std::floor((low - origin) / width), b = std::floor((high - origin) / width);
        if (!(b >= 0.0) || !(a < count)) return;
        first = static_cast<std::int64_t>(std::max(a, 0.0));
        last = static_cast<std::int64_t>(std::min(b, count - 1.0));
    }
    double share(std::int64_t i) const {
        const double begin = origin + static_cast<double>(i) * width;
        return std::max(std::min(high, begin + width) - std::max(low, begin), 0.0) / (high - low);
    }
};

const Terrain* terrain_of(const Scene& scene, const RasterSettings& rasters) {
    if (!rasters.terrain) return nullptr;
    return std::get<TerrainWall>(scene.walls[raw(*rasters.terrain)].shape).terrain.get();
}

}  // namespace

double highest_point(const State& state, std::size_t i) {
    const Bodies& b = state.bodies;
    if (b.is_sphere(i)) return b.position[i].z() + b.radius[i];
    const Vec3 up = b.orientation[i].conjugate() * Vec3::UnitZ();
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : state.shapes[raw(b.shape[i])].vertex) most = std::max(most, up.dot(v));
    return b.position[i].z() + most;
}

double ground_height(const Scene& scene, const RasterSettings& rasters, double x, double y) {
    const Terrain* terrain = terrain_of(scene, rasters);
    if (terrain == nullptr) return rasters.level;
    const auto triangle = terrain->column(x, y);
    if (!triangle) return std::numeric_limits<double>::quiet_NaN();
    const TerrainMesh::Triangle& t = terrain->mesh.triangle[*triangle];
    const Vec3& p = terrain->mesh.vertex[t.corner[0]];
    return p.z() - (t.normal.x() * (x - p.x()) + t.normal.y() * (y - p.y())) / t.normal.z();
}

Rasters::Rasters(const Scene& scene, const Communicator& ranks) : ranks_(ranks) {
    if (!scene.rasters) return;
    const RasterGrid& grid = scene.rasters->grid;
    unit_ = std::exp2(std::ilogb(grid.dx) - kUnitBits);
    const Division rows{grid.rows, 1, ranks.size()};
    first_cell_ = rows.first(ranks.rank()) * grid.columns;
    cells_ = static_cast<std::size_t>(rows.first(ranks.rank() + 1) * grid.columns - first_cell_);
}

void Rasters::begin(const Scene& scene, State& state) {
    RasterState& rasters = state.rasters;
    rasters.columns = scene.rasters->grid.columns;
    for (auto* values : {&rasters.depth, &rasters.height, &rasters.speed}) values->assign(cells_, 0.0);
    rasters.arrival.assign(cells_, RasterState::kNever);
    const BodiesTogether all = together(scene, state.bodies, nullptr, ranks_);
    rasters.volume = all.volume;
    rasters.centre = all.centre;
    rasters.top = highest_of_all(state, ranks_);
    sample(scene, state);
}

void Rasters::touch_all(const Scene& scene, const State& state) {
    const RasterSettings& rasters = *scene.rasters;
    const RasterGrid& grid = rasters.grid;
    const Bodies& bodies = state.bodies;
    const double area = grid.dx * grid.dy * rasters.solid_fraction;
    touches_.clear();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.is_ghost(i)) continue;
        const Vec3& x = bodies.position[i];
        const double volume = bodies.mass[i] / scene.materials[raw(bodies.material[i])].density;
        const double side = std::sqrt(std::numbers::pi) * std::cbrt(0.75 * volume / std::numbers::pi);
        const Overlap across(x.x(), side, grid.x, grid.dx, grid.columns), up(x.y(), side, grid.y, grid.dy, grid.rows);
        if (across.first > across.last || up.first > up.last) continue;
        const double height = highest_point(state, i) - ground_height(scene, rasters, x.x(), x.y());
        const double speed = bodies.velocity[i].norm();
        for (std::int64_t j = up.first; j <= up.last; ++j)
            for (std::int64_t c = across.first; c <= across.last; ++c) {
                const double depth = volume * across.share(c) * up.share(j) / area;
                touches_.push_back({static_cast<std::uint64_t>(j) * grid.columns + static_cast<std::uint64_t>(c),
                                    std::llround(depth / unit_), std::isnan(height) ? 0.0 : height, speed});
            }
    }
}

// One a cell, in order of cells.
void Rasters::merge() {
    std::sort(touches_.begin(), touches_.end(), [](const Touch& a, const Touch& b) { return a.cell < b.cell; });
    std::size_t kept = 0;
    for (const Touch& t : touches_) {
        if (kept > 0 && touches_[kept - 1].cell == t.cell) {
            Touch& sum = touches_[kept - 1];
            sum.depth += t.depth;
            sum.height = std::max(sum.height, t.height);
            sum.speed = std::max(sum.speed, t.speed);
        } else {
            touches_[kept++] = t;
        }
    }
    touches_.resize(kept);
}

// Each to the rank that has its cell.
void Rasters::send_home(const RasterGrid& grid) {
    merge();
    if (ranks_.alone()) return;
    const Division rows{grid.rows, 1, ranks_.size()};
    Outbox box;
    int rank = 0;
    for (const Touch& t : touches_) {
        while (rows.first(rank + 1) * grid.columns <= t.cell) ++rank;
        box[rank].put(t);
    }
    touches_.clear();
    for (const Communicator::Message& message : ranks_.exchange(box.take())) {
        Unpacker unpacker(message.bytes);
        while (!unpacker.empty()) touches_.push_back(unpacker.get<Touch>());
    }
    merge();
}

void Rasters::sample(const Scene& scene, State& state) {
    touch_all(scene, state);
    send_home(scene.rasters->grid);
    RasterState& rasters = state.rasters;
    for (const Touch& t : touches_) {
        const std::size_t cell = t.cell - first_cell_;
        const double depth = static_cast<double>(t.depth) * unit_;
        rasters.depth[cell] = std::max(rasters.depth[cell], depth);
        rasters.height[cell] = std::max(rasters.height[cell], t.height);
        rasters.speed[cell] = std::max(rasters.speed[cell], t.speed);
        if (depth > scene.rasters->covered) rasters.arrival[cell] = std::min(rasters.arrival[cell], state.time);
    }
}

std::vector<double> Rasters::depth(const Scene& scene, const State& state) {
    touch_all(scene, state);
    send_home(scene.rasters->grid);
    std::vector<double> depth(cells_, 0.0);
    for (const Touch& t : touches_) depth[t.cell - first_cell_] = static_cast<double>(t.depth) * unit_;
    return depth;
}

}  // namespace scree::solvers
