#include "scenarios/terrain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "io/atomic_file.hpp"
#include "io/checksum.hpp"
#include "io/terrain/esri_grid.hpp"
#include "io/terrain/gzip.hpp"
#include "scenarios/polygon.hpp"
#include "scenarios/release.hpp"
#include "scenarios/shapes/mesh_formats.hpp"

namespace scree::scenarios {
namespace {

constexpr double kOnTheLine = 1e-6;  // of a cell: nodes so near to a crop's line are on it

std::string lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

// The bytes on every rank, as the file has them.
std::string shared_bytes(const std::string& path, const Communicator& ranks) {
    std::string bytes, fault;
    if (ranks.root()) {
        try {
            bytes = io::read_text(path);
        } catch (const IoError& error) {
            fault = error.what();
        }
    }
    ranks.broadcast(fault);
    if (!fault.empty()) throw IoError(fault);
    ranks.broadcast(bytes);
    return bytes;
}

bool ends_with_any(const std::string& name, std::initializer_list<const char*> endings) {
    return std::any_of(endings.begin(), endings.end(), [&](const char* ending) { return name.ends_with(ending); });
}

// Nodes first, first + stride, ... up to `last` along one axis.
struct Kept {
    std::uint32_t first = 0, count = 0, stride = 1;
};

Kept kept(double node, double size, std::uint32_t n, double low, double high, std::uint32_t stride) {
    const double a = std::ceil((low - node) / size - kOnTheLine), b = std::floor((high - node) / size + kOnTheLine);
    const double first = std::max(a, 0.0), last = std::min(b, n - 1.0);
    if (!(first <= last)) return {};
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>((last - first) / stride) + 1, stride};
}

HeightGrid part_of(const HeightGrid& grid, const Kept& x, const Kept& y) {
    HeightGrid part{x.count,
                    y.count,
                    grid.x + x.first * grid.dx,
                    grid.y + y.first * grid.dy,
                    x.stride * grid.dx,
                    y.stride * grid.dy,
                    {}};
    part.height.reserve(std::size_t{x.count} * y.count);
    for (std::uint32_t j = 0; j < y.count; ++j)
        for (std::uint32_t i = 0; i < x.count; ++i)
            part.height.push_back(grid.at(x.first + i * x.stride, y.first + j * y.stride));
    return part;
}

void crop(const io::Node& node, const Context& context, HeightGrid& grid) {
    const auto stride = static_cast<std::uint32_t>(node.has("stride") ? node.integer("stride") : 1);
    const double far = std::numeric_limits<double>::infinity();
    double at[4] = {-far, -far, far, far};
    if (node.has("crop"))
        for (std::size_t k = 0; k < 4; ++k) at[k] = node.at("crop").at(k).number();
    const Kept x = kept(grid.x, grid.dx, grid.columns, at[0], at[2], stride),
               y = kept(grid.y, grid.dy, grid.rows, at[1], at[3], stride);
    if (x.count >= 2 && y.count >= 2) {
        if (x.count < grid.columns || y.count < grid.rows) grid = part_of(grid, x, y);
        return;
    }
    const char* const cause = node.has("crop") ? "crop" : node.has("stride") ? "stride" : "path";
    context.error(node.at(cause),
                  fmt::format("{} x {} nodes are left; two along each axis are needed. The nodes of the file are {} x "
                              "{}, from [{:.9g}, {:.9g}] to [{:.9g}, {:.9g}]",
                              x.count, y.count, grid.columns, grid.rows, grid.x, grid.y, grid.last_x(), grid.last_y()));
}

void read_grid(const io::Node& node, const Context& context, const std::string& path, std::string bytes,
               TerrainFile& file) {
    if (io::is_gzip(bytes)) bytes = io::gunzip(bytes, path);
    HeightGrid grid = io::parse_esri_grid(bytes, path);
    const std::size_t before = context.errors();
    const double x = grid.x, y = grid.y, dx = grid.dx, dy = grid.dy;
    crop(node, context, grid);
    if (context.errors() != before) return;
    const double scale = number_or(node, "scale", 1.0);
    if (node.has("cell")) {  // the nodes are counted from the file's lower left one
        const double wide = node.at("cell").at(0).number(), deep = node.at("cell").at(1).number();
        grid.x = std::round((grid.x - x) / dx) * wide, grid.y = std::round((grid.y - y) / dy) * deep;
        grid.dx = std::round(grid.dx / dx) * wide, grid.dy = std::round(grid.dy / dy) * deep;
    } else {
        grid.x *= scale, grid.y *= scale, grid.dx *= scale, grid.dy *= scale;
    }
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const double hole = number_or(node, "fill_nodata", std::nan(""));
    for (double& z : grid.height) {
        z = std::isnan(z) ? hole : z * scale;
        if (!std::isnan(z)) low = std::min(low, z), high = std::max(high, z);
    }
    if (!(low <= high)) {
        context.error(node.at("path"), fmt::format("'{}' has no heights here: every node is without data", path));
        return;
    }
    file.lower = Vec3(grid.x, grid.y, low) + file.offset;
    file.upper = Vec3(grid.last_x(), grid.last_y(), high) + file.offset;
    file.grid = std::move(grid);
}

void read_mesh(const io::Node& node, const Context& context, const std::string& path, std::string bytes,
               TerrainFile& file) {
    for (const char* key : {"cell", "crop", "stride", "fill_nodata", "release"}) {
        if (node.has(key)) {
            context.error(node.at(key), "is for grids of heights (.asc, .asc.gz); the path names a mesh");
        }
    }
    Polyhedron mesh = parse_mesh({path, std::move(bytes)});
    join_equal_vertices(mesh);
    const double scale = number_or(node, "scale", 1.0);
    for (Vec3& x : mesh.vertex) {
        x *= scale;
        if (!x.allFinite()) throw IoError(fmt::format("{}: a vertex has a coordinate that is no finite number", path));
    }
    for (const auto& loop : mesh.face)
        for (std::size_t k = 2; k < loop.size(); ++k) {
            if (loop[0] == loop[k - 1] || loop[k - 1] == loop[k] || loop[k] == loop[0]) continue;  // no area
            file.triangle.push_back({loop[0], loop[k - 1], loop[k]});
        }
    file.vertex = std::move(mesh.vertex);
    if (file.triangle.empty()) {
        context.error(node.at("path"), fmt::format("'{}' holds no face with an area", path));
        return;
    }
    file.lower = file.upper = file.vertex[file.triangle[0][0]] + file.offset;
    for (const TriangleCorners& t : file.triangle)
        for (const std::uint32_t v : t) {
            file.lower = file.lower.cwiseMin(file.vertex[v] + file.offset);
            file.upper = file.upper.cwiseMax(file.vertex[v] + file.offset);
        }
}

TerrainFile read_terrain(const io::Node& node, const Context& context, const Communicator& ranks) {
    TerrainFile file;
    file.offset = vector_or(node, "offset", Vec3::Zero());
    const std::string path = (std::filesystem::path(context.folder) / node.text("path")).lexically_normal().string();
    const std::string name = lower_case(path);
    const bool is_grid = ends_with_any(name, {".asc", ".asc.gz"});
    if (!is_grid && !ends_with_any(name, {".off", ".obj", ".stl", ".ply"})) {
        context.error(node.at("path"), fmt::format("what '{}' is cannot be told from its name; .asc, .asc.gz, .off, "
                                                   ".obj, .stl or .ply is expected at its end",
                                                   path));
        return {};
    }
    try {
        std::string bytes = shared_bytes(path, ranks);
        io::Checksum sum;
        sum.add(bytes.data(), bytes.size());
        file.checksum = fmt::format("sum-{:016x}", sum.value());
        if (node.has("checksum") && node.text("checksum") != file.checksum) {
            context.error(node.at("checksum"), fmt::format("'{}' is not the file that is meant: its checksum is {}, {} "
                                                           "is expected",
                                                           path, file.checksum, node.text("checksum")));
            return {};
        }
        if (is_grid)
            read_grid(node, context, path, std::move(bytes), file);
        else
            read_mesh(node, context, path, std::move(bytes), file);
    } catch (const io::EsriFault& fault) {
        context.diagnostics.error({path, fault.line, 1}, fault.fault);
        return {};
    } catch (const IoError& error) {
        context.error(node.at("path"), error.what());
        return {};
    }
    return file;
}

void add_zone(const io::Node& node, const Context& context, MaterialIndex wall, Terrain& terrain) {
    const MaterialIndex material = context.material(node.at("material"));
    const Polygon polygon(node.at("polygon"), context);
    if (!polygon.has_area()) return;
    if (terrain.material.empty()) terrain.material.assign(terrain.mesh.triangle.size(), wall);
    bool any = false;
    for (std::uint32_t t = 0; t < terrain.ground; ++t) {
        const TriangleCorners& c = terrain.mesh.triangle[t].corner;
        const Vec3 middle = (terrain.mesh.vertex[c[0]] + terrain.mesh.vertex[c[1]] + terrain.mesh.vertex[c[2]]) / 3.0;
        if (!polygon.holds(middle.x(), middle.y())) continue;
        terrain.material[t] = material;
        any = true;
    }
    if (!any) context.warning(node.at("polygon"), "no triangle of the terrain lies in this zone");
}

WallShape finished(const io::Node& node, const Context& context, const std::string& checksum, Terrain terrain) {
    terrain.checksum = checksum;
    const MaterialIndex wall = context.material(node.at("material"));
    for (const io::Node& zone : items_of(node, "zones")) add_zone(zone, context, wall, terrain);
    return TerrainWall{std::make_shared<const Terrain>(std::move(terrain))};
}

}  // namespace

std::vector<TerrainFile> read_terrains(const io::Node& scenario, const Context& context, const Communicator& ranks) {
    std::vector<TerrainFile> files;
    for (const io::Node& node : items_of(scenario, "walls"))
        if (node.text("shape") == "terrain") files.push_back(read_terrain(node, context, ranks));
    return files;
}

WallShape build_terrain(const io::Node& node, TerrainFile file, const Context& context) {
    // for a terrain that cannot be made: the scenario is refused, but the rest of it is looked at first
    const PlaneWall nowhere{{0.0, 0.0, -1e300}, Vec3::UnitZ()};
    if (node.has("motion")) context.error(node.at("motion"), "a terrain does not move");
    if (file.empty()) return nowhere;
    const TerrainBorder border =
        node.has("border") && node.text("border") == "closed" ? TerrainBorder::closed : TerrainBorder::open;
    const Vec3 shift = file.offset - context.origin;
    try {
        if (file.grid) {
            file.grid->x += shift.x(), file.grid->y += shift.y();
            for (double& z : file.grid->height) z += shift.z();
            std::optional<TerrainRelease> release;
            if (node.has("release")) release = cut_release(node.at("release"), context, *file.grid);
            Terrain terrain = make_terrain(std::move(*file.grid), border);
            terrain.release = std::move(release);
            return finished(node, context, file.checksum, std::move(terrain));
        }
        for (Vec3& x : file.vertex) x += shift;
        return finished(node, context, file.checksum,
                        make_terrain(std::move(file.vertex), std::move(file.triangle), border));
    } catch (const ScenarioError& error) {
        context.error(node.at("path"), fmt::format("'{}' is no terrain: {}", node.text("path"), error.what()));
        return nowhere;
    }
}

}  // namespace scree::scenarios
