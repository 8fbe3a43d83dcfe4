#include "io/results/raster_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "core/parallel/together.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"
#include "io/hdf5/shared_file.hpp"
#include "io/terrain/esri_grid.hpp"

namespace scree::io {
namespace {

constexpr std::size_t kChunkCells = 65536;
constexpr std::array<const char*, 5> kNames = {"flow_depth_max", "flow_height_max", "speed_max", "arrival_time",
                                               "deposit"};

struct Named {
    const char* name;
    Meaning meaning;
    const std::vector<double>& values;
};

void write_hdf5(const std::string& path, const Scene& scene, double time, const std::vector<Named>& rasters,
                const Provenance& provenance, const Communicator& ranks) {
    const RasterSettings& settings = *scene.rasters;
    const RasterGrid& grid = settings.grid;
    AtomicFile out(path, ranks);
    SharedFile file(out.temporary(), 0, ranks);
    file.by_root([&](const Hdf5Group& root) {
        write_format(root, "scree rasters");
        root.attribute("time", time);
        root.attribute("units", "time s");
        write_provenance(root, provenance);
        const Hdf5Group group = root.group("rasters");
        group.attribute("x", grid.x + scene.origin.x());
        group.attribute("y", grid.y + scene.origin.y());
        group.attribute("dx", grid.dx);
        group.attribute("dy", grid.dy);
        group.attribute("units", "m");
        group.attribute("solid_fraction", settings.solid_fraction);
        group.attribute("covered", settings.covered);
    });
    const Layout layout{.gzip = scene.output.compression,
                        .chunk_rows = std::max<std::size_t>(kChunkCells / grid.columns, 1)};
    for (const Named& raster : rasters) {
        Rows rows = rows_of(raster.values);
        rows.count = raster.values.size() / grid.columns;
        rows.shape = {grid.columns};
        file.rows(std::string("rasters/") + raster.name, rows, raster.meaning, layout);
    }
    file.close();
    out.commit();
}

void write_esri(const std::string& folder, const Hdf5Group& root, const char* name, const Scene& scene) {
    const RasterGrid& cells = scene.rasters->grid;
    // ESRI's cells are about the nodes of a grid of heights.
    HeightGrid grid{cells.columns,
                    cells.rows,
                    cells.x + 0.5 * cells.dx + scene.origin.x(),
                    cells.y + 0.5 * cells.dy + scene.origin.y(),
                    cells.dx,
                    cells.dy,
                    {}};
    grid.height = read_numbers(root, std::string("rasters/") + name);
    write_esri_grid(folder + "/" + name + ".asc", grid);
}

}  // namespace

void write_raster_file(const std::string& path, const Scene& scene, const State& state,
                       const std::vector<double>& deposit, const Provenance& provenance, const Communicator& ranks) {
    const RasterState& r = state.rasters;
    std::vector<double> arrival = r.arrival;
    std::replace(arrival.begin(), arrival.end(), RasterState::kNever, std::numeric_limits<double>::quiet_NaN());
    const std::vector<Named> rasters = {
        {kNames[0], {"m", "largest flow depth: volume over a cell / (its area times solid_fraction)"}, r.depth},
        {kNames[1], {"m", "largest height of a body's highest point above the ground"}, r.height},
        {kNames[2], {"m/s", "largest speed of a body"}, r.speed},
        {kNames[3], {"s", "when the flow depth first was above `covered`; NaN: never"}, arrival},
        {kNames[4], {"m", "flow depth now"}, deposit},
    };
    by_root(ranks, [&] { make_folder(std::filesystem::path(path).parent_path().string()); });
    write_hdf5(path, scene, state.time, rasters, provenance, ranks);
}

void write_rasters(const std::string& folder, const Scene& scene, const State& state,
                   const std::vector<double>& deposit, const Provenance& provenance, const Communicator& ranks) {
    const std::string path = folder + "/rasters.h5";
    write_raster_file(path, scene, state, deposit, provenance, ranks);
    by_root(ranks, [&] {
        const Hdf5File file = Hdf5File::open(path);
        for (const char* name : kNames) write_esri(folder, file.root(), name, scene);
    });
}

}  // namespace scree::io
