#include "app/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/human_text.hpp"
#include "app/output_schedule.hpp"
#include "app/rank_shares.hpp"
#include "core/terrain.hpp"
#include "solvers/measures.hpp"

namespace scree::app {
namespace {

constexpr double kRasterBytes = 32.0;  // a cell: four doubles

// The surfaces of polyhedra: points in single precision, corners and kinds of the faces, the body of each face.
double mesh_bytes(const State& state) {
    double bytes = 0.0;
    for (const ShapeIndex s : state.bodies.shape) {
        if (s == kSphere) continue;
        const ConvexShape& shape = state.shapes[raw(s)];
        bytes += 12.0 * static_cast<double>(shape.vertex.size()) + 4.0 * static_cast<double>(shape.corner.size()) +
                 16.0 * static_cast<double>(shape.face.size());
    }
    return bytes;
}

double snapshot_bytes_per_body(const OutputSettings& output, bool shapes) {
    double bytes = 8.0 + 24.0 + 8.0;  // id, position, radius
    if (shapes) bytes += 4.0 + 32.0;
    for (const std::string& field : output.fields) {
        if (field == "velocity" || field == "spin") bytes += 24.0;
        if (field == "orientation" && !shapes) bytes += 32.0;
        if (field == "mass") bytes += 8.0;
        if (field == "material") bytes += 2.0;
    }
    return bytes;
}

std::string terrain_text(const Terrain& terrain, const Vec3& origin) {
    std::string text = fmt::format(" of {} triangles", count_text(terrain.ground));
    if (terrain.grid) {
        text += fmt::format(", {} x {} nodes {:.6g} x {:.6g} m apart", terrain.grid->columns, terrain.grid->rows,
                            terrain.grid->dx, terrain.grid->dy);
    }
    return text + fmt::format(", {} to {}, {} border, {}", point_text(origin + terrain.lower),
                              point_text(origin + terrain.upper),
                              terrain.border == TerrainBorder::open ? "open" : "closed",
                              bytes_text(static_cast<double>(terrain.bytes())));
}

std::string wall_shape(const Wall& wall, const Vec3& origin) {
    static constexpr std::array<const char*, std::variant_size_v<WallShape>> kNames = {
        "plane", "box", "cylinder", "cone", "disc", "floor with a round hole", "floor with a slot", "terrain"};
    std::string text = kNames[wall.shape.index()];
    if (const auto* w = std::get_if<TerrainWall>(&wall.shape)) text += terrain_text(*w->terrain, origin);
    if (wall.motion.moves()) text += ", moves";
    if (wall.appears > 0.0) text += fmt::format(", from {:.4g} s", wall.appears);
    if (wall.goes < kForever) text += fmt::format(", until {:.4g} s", wall.goes);
    return text;
}

std::string release_line(const Wall& wall) {
    const auto* terrain = std::get_if<TerrainWall>(&wall.shape);
    if (terrain == nullptr || !terrain->terrain->release) return "";
    const TerrainRelease& release = *terrain->terrain->release;
    return fmt::format(
        "  release     {:.4g} m3 above the sliding planes of '{}', up to {:.4g} m deep, over {:.4g} m2\n",
        release.volume, wall.name, release.deepest, release.area);
}

std::string bodies_lines(const Scene& scene, const State& state) {
    const Bodies& bodies = state.bodies;
    if (bodies.size() == 0) return "  bodies      none at the start\n";
    double mass = 0.0;
    Vec3 lower = bodies.position.front(), upper = lower;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        mass += bodies.mass[i];
        lower = lower.cwiseMin(bodies.position[i]);
        upper = upper.cwiseMax(bodies.position[i]);
    }
    const auto [small, large] = std::minmax_element(bodies.radius.begin(), bodies.radius.end());
    std::string text = fmt::format("  bodies      {}, {:.5g} kg\n", plural(bodies.size(), "body", "bodies"), mass);
    const char* const what = bodies.has_shapes() ? " (of the balls that hold them)" : "";
    text += *small == *large
                ? fmt::format("  diameter    {}{}\n", length_text(2.0 * *small), what)
                : fmt::format("  diameters   {} to {}{}\n", length_text(2.0 * *small), length_text(2.0 * *large), what);
    return text +
           fmt::format("  centres     {} to {}\n", point_text(scene.origin + lower), point_text(scene.origin + upper));
}

double bytes_of(const ConvexShape& s) {
    return static_cast<double>(sizeof(ConvexShape) + s.vertex.size() * sizeof(Vec3) +
                               s.face.size() * sizeof(ConvexShape::Face) + s.edge.size() * sizeof(ConvexShape::Edge) +
                               (s.corner.size() + s.link_begin.size() + s.link.size()) * sizeof(std::uint32_t));
}

// All shapes that were made from one item of the scenario.
struct ShapesOfName {
    std::string name;
    std::uint64_t shapes = 0, bodies = 0;
    std::size_t least_vertices = 0, most_vertices = 0;
    double smallest = 0.0, largest = 0.0;  // [m3]

    void add(const ConvexShape& shape, std::uint64_t instances) {
        const std::size_t n = shape.vertex.size();
        least_vertices = shapes == 0 ? n : std::min(least_vertices, n);
        most_vertices = std::max(most_vertices, n);
        smallest = shapes == 0 ? shape.volume : std::min(smallest, shape.volume);
        largest = std::max(largest, shape.volume);
        ++shapes;
        bodies += instances;
    }
    std::string text() const {
        std::string line = fmt::format("  shape       {}: {}", name, plural(bodies, "body", "bodies"));
        if (shapes > 1) line += fmt::format(", {} shapes", count_text(shapes));
        line += least_vertices == most_vertices ? fmt::format(", {} vertices", most_vertices)
                                                : fmt::format(", {} to {} vertices", least_vertices, most_vertices);
        const std::string least = fmt::format("{:.4g}", smallest), most = fmt::format("{:.4g}", largest);
        return line + (least == most ? fmt::format(", {} m3\n", most) : fmt::format(", {} to {} m3\n", least, most));
    }
};

std::string scene_lines(const Scene& scene) {
    std::string text;
    for (const Wall& wall : scene.walls) {
        text += fmt::format("  wall        {}: {}\n", wall.name, wall_shape(wall, scene.origin));
        text += release_line(wall);
    }
    for (const Inlet& inlet : scene.inlets) {
        text += fmt::format("  inlet       {}: {:.4g} kg/s\n", inlet.name, inlet.mass_rate);
    }
    for (const Outlet& outlet : scene.outlets) text += fmt::format("  outlet      {}\n", outlet.name);
    if (scene.rasters) {
        const RasterGrid& grid = scene.rasters->grid;
        text += fmt::format("  rasters     {} x {} cells of {} x {}, every {}; {} over all ranks\n", grid.columns,
                            grid.rows, length_text(grid.dx), length_text(grid.dy),
                            plural(scene.rasters->sample_every, "step", "steps"),
                            bytes_text(kRasterBytes * static_cast<double>(grid.cells())));
    }
    for (const Measure& measure : scene.measures) {
        text +=
            fmt::format("  measure     {}, mean over {:.4g} to {:.4g} s\n", measure.name, measure.from, measure.until);
    }
    return text;
}

std::string time_line(const Scene& scene, const OutputSchedule& schedule) {
    std::string text = fmt::format("  time        {:.6g} s in {} of {:.4g} s\n", scene.time.end,
                                   plural(schedule.steps, "step", "steps"), scene.time.step);
    const double reached = static_cast<double>(schedule.steps) * scene.time.step;
    if (reached > scene.time.end * (1.0 + 1e-9)) {
        text +=
            fmt::format("              (time.end is no multiple of time.step: the run ends at {:.9g} s)\n", reached);
    }
    return text;
}

}  // namespace

std::string shapes_lines(const State& state, const std::vector<std::string>& name) {
    if (state.shapes.empty()) return "";
    std::vector<std::uint64_t> bodies(state.shapes.size(), 0);
    for (const ShapeIndex s : state.bodies.shape)
        if (s != kSphere) ++bodies[raw(s)];
    std::vector<ShapesOfName> lines;
    for (std::size_t s = 0; s < state.shapes.size(); ++s) {
        const auto same = [&](const ShapesOfName& line) { return line.name == name[s]; };
        auto line = std::find_if(lines.begin(), lines.end(), same);
        if (line == lines.end()) line = lines.insert(lines.end(), {name[s]});
        line->add(state.shapes[s], bodies[s]);
    }
    std::string text;
    double held = 0.0;
    for (const ShapesOfName& line : lines) text += line.text();
    for (const ConvexShape& shape : state.shapes) held += bytes_of(shape);
    return text + fmt::format("              {} in all, {} on each rank\n",
                              plural(state.shapes.size(), "shape", "shapes"), bytes_text(held));
}

CostEstimate estimate_cost(const Scene& scene, const Plan& plan, const State& state) {
    const OutputSchedule schedule(scene.time, scene.output);
    const auto bodies = static_cast<double>(state.bodies.size());
    CostEstimate cost;
    cost.contacts = contacts_per_body(plan) * bodies;
    cost.memory =
        static_cast<double>(plan.bytes_per_body) * bodies + static_cast<double>(plan.bytes_per_contact) * cost.contacts;
    cost.snapshot = snapshot_bytes_per_body(scene.output, !state.shapes.empty()) * bodies;
    if (scene.output.mesh) cost.snapshot += mesh_bytes(state);
    if (scene.output.contacts)
        cost.snapshot += 117.0 * cost.contacts;  // ids, point, normal, gap, impulse, force, status
    cost.snapshots = cost.snapshot * static_cast<double>(schedule.snapshots());
    double columns = 0.0;
    for (const HistoryColumn& column : solvers::history_columns(scene)) columns += column.width;
    cost.history = 8.0 * columns * static_cast<double>(schedule.history_rows());
    cost.checkpoint = 90.0 * bodies + (plan.friction ? 44.0 : 28.0) * cost.contacts;
    if (scene.rasters) cost.checkpoint += kRasterBytes * static_cast<double>(scene.rasters->grid.cells());
    return cost;
}

std::string check_report(const std::string& scenario_name, const Scene& scene, const Plan& plan, const State& state,
                         const std::vector<std::string>& shape_name, const std::vector<std::string>& warnings,
                         int ranks) {
    const OutputSchedule schedule(scene.time, scene.output);
    std::string text = fmt::format("{}: valid\n", scenario_name);
    if (!scene.title.empty()) text += fmt::format("  title       {}\n", scene.title);
    text +=
        bodies_lines(scene, state) + shapes_lines(state, shape_name) + scene_lines(scene) + time_line(scene, schedule);

    text += "plan (what the scene does not need is neither stored nor computed)\n";
    for (const PlanLine& line : plan.lines) {
        text += fmt::format("  {}  {:<16} {}\n", line.on ? "on " : "off", line.feature, line.reason);
    }
    const CostEstimate cost = estimate_cost(scene, plan, state);
    text += "cost (estimates; files before compression)\n";
    text += fmt::format("  memory      {} bytes a body, {} bytes a contact: about {} with {} contacts\n",
                        plan.bytes_per_body, plan.bytes_per_contact, bytes_text(cost.memory),
                        count_text(static_cast<std::uint64_t>(cost.contacts)));
    text += fmt::format("  snapshots   {}, {} each: {}\n", count_text(schedule.snapshots()), bytes_text(cost.snapshot),
                        bytes_text(cost.snapshots));
    text +=
        fmt::format("  history     {}: {}\n", plural(schedule.history_rows(), "row", "rows"), bytes_text(cost.history));
    text += fmt::format("  checkpoints the last two, {} each\n", bytes_text(cost.checkpoint));
    if (ranks > 0) text += shares_text(share_out(scene, state, ranks), plan);
    if (warnings.empty()) return text + "no warnings\n";
    text += warnings.size() == 1 ? "warning\n" : "warnings\n";
    for (const std::string& warning : warnings) text += "  - " + warning + "\n";
    return text;
}

}  // namespace scree::app
