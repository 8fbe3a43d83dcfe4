#include "io/results/terrain_file.hpp"

#include <algorithm>
#include <span>

#include "core/parallel/together.hpp"
#include "core/terrain.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"

namespace scree::io {
namespace {

void write_grid(const Hdf5Group& group, const HeightGrid& grid, const Vec3& origin, const Layout& layout) {
    std::vector<double> height = grid.height;
    for (double& z : height) z += origin.z();
    Rows rows = rows_of(height);
    rows.count = grid.rows;
    rows.shape = {grid.columns};
    write_rows(group, "height", rows, {"m", "heights of the nodes, NaN without data; southernmost row first", "world"},
               layout);
    group.attribute("x", grid.x + origin.x());
    group.attribute("y", grid.y + origin.y());
    group.attribute("dx", grid.dx);
    group.attribute("dy", grid.dy);
    group.attribute("units", "m");
}

void write_surface(const Hdf5Group& group, const Terrain& terrain, const Vec3& origin, const Layout& layout) {
    std::vector<std::uint32_t> corners;
    corners.reserve(std::size_t{3} * terrain.ground);
    for (std::uint32_t t = 0; t < terrain.ground; ++t) {
        const auto& corner = terrain.mesh.triangle[t].corner;
        corners.insert(corners.end(), corner.begin(), corner.end());
    }
    // The vertices of the sides come after those of the ground.
    const std::size_t count = 1 + *std::max_element(corners.begin(), corners.end());
    std::vector<Vec3> vertex(terrain.mesh.vertex.begin(),
                             terrain.mesh.vertex.begin() + static_cast<std::ptrdiff_t>(count));
    for (Vec3& x : vertex) x += origin;
    write_rows(group, "vertex", rows_of(vertex), {"m", "vertices of the ground", "world"}, layout);
    Rows rows = rows_of(corners);
    rows.count = terrain.ground;
    rows.shape = {3};
    write_rows(group, "triangle", rows, {"1", "rows of vertex, counter-clockwise seen from outside"}, layout);
}

}  // namespace

bool has_terrain(const Scene& scene) {
    return std::any_of(scene.walls.begin(), scene.walls.end(),
                       [](const Wall& wall) { return std::holds_alternative<TerrainWall>(wall.shape); });
}

void write_terrain(const std::string& path, const Scene& scene, const Provenance& provenance,
                   const Communicator& ranks) {
    const Layout layout{.gzip = scene.output.compression};
    by_root(ranks, [&] {
        AtomicFile out(path);
        Hdf5File file = Hdf5File::create(out.temporary());
        write_format(file.root(), "scree terrain");
        const Hdf5Group all = file.root().group("terrain");
        for (std::size_t w = 0; w < scene.walls.size(); ++w) {
            const auto* wall = std::get_if<TerrainWall>(&scene.walls[w].shape);
            if (wall == nullptr) continue;
            const Hdf5Group group = all.group(std::to_string(w));
            const Terrain& terrain = *wall->terrain;
            if (terrain.grid) write_grid(group, *terrain.grid, scene.origin, layout);
            if (!terrain.grid || scene.output.mesh) write_surface(group, terrain, scene.origin, layout);
        }
        write_provenance(file.root(), provenance);
        file.close();
        out.commit();
    });
}

}  // namespace scree::io
