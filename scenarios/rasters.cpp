#include "scenarios/rasters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/terrain.hpp"

namespace scree::scenarios {
namespace {

using Node = io::Node;

constexpr std::uint64_t kUsualSteps = 10;  // between samples
constexpr double kMostCells = 1e10;

const HeightGrid* grid_of(const Wall& wall) {
    const auto* terrain = std::get_if<TerrainWall>(&wall.shape);
    return terrain != nullptr && terrain->terrain->grid ? &*terrain->terrain->grid : nullptr;
}

// The wall that is named, or the only one that can be meant.
std::optional<WallIndex> ground_of(const Node& node, const Context& context, const Scene& scene) {
    std::vector<std::string> names;
    std::vector<std::size_t> grids;
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        names.push_back(scene.walls[w].name);
        if (grid_of(scene.walls[w]) != nullptr) grids.push_back(w);
    }
    std::size_t chosen = 0;
    if (node.has("terrain")) {
        chosen = context.find(node.at("terrain"), names, "wall");
        if (chosen < names.size() && grid_of(scene.walls[chosen]) == nullptr) {
            context.error(node.at("terrain"), "rasters need terrain from a grid of heights; this wall is none");
            return std::nullopt;
        }
    } else if (grids.size() == 1) {
        chosen = grids.front();
    } else {
        return std::nullopt;
    }
    return WallIndex{static_cast<std::uint32_t>(chosen)};
}

struct Corner {
    double x, y;
};
Corner corner_or(const Node& node, const char* key, const Context& context, const Corner& otherwise) {
    if (!node.has(key)) return otherwise;
    return {node.at(key).at(0).number() - context.origin.x(), node.at(key).at(1).number() - context.origin.y()};
}

// Cells of a line that begins at `first`: those whose centre lies in [low, high].
void choose(double low, double high, double size, double first, std::uint32_t count, double& begin,
            std::uint32_t& chosen) {
    const double from = std::max(std::ceil((low - first) / size - 0.5), 0.0);
    const double to = std::min(std::floor((high - first) / size - 0.5), count - 1.0);
    begin = first + from * size;
    chosen = to >= from ? static_cast<std::uint32_t>(to - from) + 1 : 0;
}

// The cells about the nodes of the terrain.
RasterGrid cells_of(const HeightGrid& nodes, const Corner& low, const Corner& high) {
    RasterGrid grid;
    grid.dx = nodes.dx, grid.dy = nodes.dy;
    choose(low.x, high.x, nodes.dx, nodes.x - 0.5 * nodes.dx, nodes.columns, grid.x, grid.columns);
    choose(low.y, high.y, nodes.dy, nodes.y - 0.5 * nodes.dy, nodes.rows, grid.y, grid.rows);
    return grid;
}

// Square cells from `low` on, until `high` is inside.
RasterGrid square_cells(double size, const Corner& low, const Corner& high) {
    const double columns = std::ceil((high.x - low.x) / size * (1.0 - 1e-12)),
                 rows = std::ceil((high.y - low.y) / size * (1.0 - 1e-12));
    if (!(columns >= 1.0 && rows >= 1.0 && columns * rows <= kMostCells)) return {};
    return {static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows), low.x, low.y, size, size};
}

}  // namespace

void build_rasters(const Node& scenario, const Context& context, Scene& scene) {
    if (!scenario.has("rasters")) return;
    const Node& node = scenario.at("rasters");
    RasterSettings rasters;
    rasters.terrain = ground_of(node, context, scene);
    const HeightGrid* nodes = rasters.terrain ? grid_of(scene.walls[raw(*rasters.terrain)]) : nullptr;
    if (nodes == nullptr && !(node.has("cell") && node.has("lower") && node.has("upper"))) {
        context.error(node, "without one terrain made of a grid, rasters need `cell`, `lower` and `upper`");
        return;
    }
    Corner low{-kForever, -kForever}, high{kForever, kForever};
    if (node.has("cell") && nodes != nullptr) low = {nodes->x, nodes->y}, high = {nodes->last_x(), nodes->last_y()};
    low = corner_or(node, "lower", context, low);
    high = corner_or(node, "upper", context, high);
    rasters.grid = node.has("cell") ? square_cells(node.number("cell"), low, high) : cells_of(*nodes, low, high);
    if (rasters.grid.cells() == 0) {
        context.error(node,
                      fmt::format("there are no cells, or more than {:g}: see `cell`, `lower`, `upper`", kMostCells));
        return;
    }
    rasters.level = number_or(node, "level", 0.0) - context.origin.z();
    rasters.sample_every = kUsualSteps;
    if (node.has("interval")) {
        rasters.sample_every =
            static_cast<std::uint64_t>(std::max(1.0, std::round(node.number("interval") / scene.time.step)));
    }
    rasters.solid_fraction = number_or(node, "solid_fraction", rasters.solid_fraction);
    rasters.covered = number_or(node, "covered", rasters.covered);
    rasters.at_snapshots = node.has("at_snapshots") && node.boolean("at_snapshots");
    scene.rasters = rasters;
}

void build_trajectories(const Node& scenario, Scene& scene) {
    if (!scenario.has("trajectories")) return;
    const Node& node = scenario.at("trajectories");
    TrajectorySettings& follow = scene.trajectories;
    for (const Node& id : items_of(node, "ids")) follow.ids.push_back(static_cast<std::uint64_t>(id.integer()));
    std::sort(follow.ids.begin(), follow.ids.end());
    follow.ids.erase(std::unique(follow.ids.begin(), follow.ids.end()), follow.ids.end());
    if (node.has("count")) follow.count = static_cast<std::uint64_t>(node.integer("count"));
    const double steps = number_or(node, "interval", 0.0) / scene.time.step;
    follow.every = static_cast<std::uint64_t>(std::max(1.0, std::round(steps)));
}

}  // namespace scree::scenarios
