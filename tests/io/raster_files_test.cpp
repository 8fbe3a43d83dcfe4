// Files of rasters and of terrain: what was kept comes back to the same bits, where it lay.
#include "io/results/raster_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"
#include "io/results/info.hpp"
#include "io/results/snapshot.hpp"
#include "io/terrain/esri_grid.hpp"
#include "io_fixtures.hpp"
#include "tests/testing/height_grid.hpp"

namespace scree::io {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

Scene raster_scene() {
    Scene scene = sample_scene();
    scene.rasters.emplace();
    scene.rasters->grid = {3, 2, -10.0, 20.0, 5.0, 4.0};
    scene.rasters->solid_fraction = 0.6;
    scene.rasters->covered = 0.25;
    return scene;
}

State raster_state() {
    State state = sample_state(1);
    RasterState& r = state.rasters;
    r.columns = 3;
    r.depth = {0.0, 0.1, 0.2, 1.0 / 3.0, 0.4, 5e-324};
    r.height = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
    r.speed = {0.0, 10.0, 20.0, 30.0, 40.0, 50.0};
    r.arrival = {RasterState::kNever, 0.1, 0.2, 0.3, RasterState::kNever, 0.5};
    return state;
}

TEST(RasterFiles, AreReadBackWhereTheyLay) {
    const TemporaryFolder folder;
    const std::vector<double> deposit = {0.0, 0.0, 0.0, 0.125, 0.0, 1.0 / 7.0};
    write_rasters(folder / "rasters", raster_scene(), raster_state(), deposit, sample_provenance(),
                  Communicator::self());
    const Hdf5File file = Hdf5File::open(folder / "rasters/rasters.h5");
    const Hdf5Group group = file.root().existing_group("rasters");
    check_format(file.root(), "scree rasters");
    EXPECT_EQ(group.number_attribute("x"), 90.0);  // the scene's origin is added
    EXPECT_EQ(group.number_attribute("y"), 220.0);
    EXPECT_EQ(group.number_attribute("solid_fraction"), 0.6);
    EXPECT_EQ(read_numbers(group, "flow_depth_max"), raster_state().rasters.depth);
    EXPECT_EQ(read_numbers(group, "flow_height_max"), raster_state().rasters.height);
    EXPECT_EQ(read_numbers(group, "speed_max"), raster_state().rasters.speed);
    EXPECT_EQ(read_numbers(group, "deposit"), deposit);
    EXPECT_TRUE(std::isnan(read_numbers(group, "arrival_time")[4]));
    for (const DatasetInfo& info : group.datasets()) {
        EXPECT_THAT(info.shape, ElementsAre(2, 3)) << info.name;
        EXPECT_NE(info.description, "") << info.name;
        const HeightGrid grid = read_esri_grid(folder / ("rasters/" + info.name + ".asc"));
        EXPECT_EQ(grid.columns, 3U);
        EXPECT_EQ(grid.x, 92.5);  // cells are about the nodes
        EXPECT_EQ(grid.y, 222.0);
        const std::vector<double> values = read_numbers(group, info.name);
        for (std::size_t k = 0; k < values.size(); ++k) {
            EXPECT_TRUE(grid.height[k] == values[k] || (std::isnan(grid.height[k]) && std::isnan(values[k])));
        }
    }
    EXPECT_THAT(info(folder / "rasters/rasters.h5"), HasSubstr("rasters/speed_max"));
}

TEST(RasterFiles, AnUnwritableFolderIsAnError) {
    const TemporaryFolder folder;
    write_rasters(folder / "a", raster_scene(), raster_state(), std::vector<double>(6), {}, Communicator::self());
    EXPECT_THROW(write_rasters(folder / "a/deposit.asc", raster_scene(), raster_state(), std::vector<double>(6), {},
                               Communicator::self()),
                 IoError);
}

TEST(TerrainFile, HoldsGridAndSurface) {
    const TemporaryFolder folder;
    Scene scene = sample_scene();
    HeightGrid grid = scree::testing::height_grid(4, 3, 10.0, 20.0, [](double x, double y) { return x + y; });
    grid.height[0] = scree::testing::kNoData;
    Wall wall;
    wall.name = "ground";
    wall.shape = scree::testing::wall_of(grid);
    scene.walls.push_back(wall);
    State state = sample_state(2);
    SnapshotSeries series(folder.path(), 0);
    series.write(scene, state, {}, {});
    const Hdf5File file = Hdf5File::open(list_snapshots(folder.path()).back());
    const Hdf5Group ground = file.root().existing_group("terrain/2");
    EXPECT_EQ(ground.number_attribute("x"), 100.0);
    EXPECT_EQ(ground.number_attribute("dy"), 20.0);
    const std::vector<double> height = read_numbers(ground, "height");
    EXPECT_THAT(ground.dataset("height").shape, ElementsAre(3, 4));
    EXPECT_TRUE(std::isnan(height[0]));
    EXPECT_EQ(height[5], 300.0 + 30.0);
    // 6 cells, one of which has lost a corner; no vertex below the ground.
    EXPECT_EQ(ground.dataset("triangle").shape.at(0), 11U);
    const std::vector<double> vertex = read_numbers(ground, "vertex");
    for (std::size_t v = 0; v < vertex.size(); v += 3) {
        EXPECT_EQ(vertex[v + 2] - 300.0, (vertex[v] - 100.0) + (vertex[v + 1] - 200.0));
    }
    EXPECT_THAT(read_text(folder / "run.xdmf"),
                AllOf(HasSubstr("Name=\"terrain\""), HasSubstr("snapshots/000000.h5:/terrain/2/vertex")));
    scene.output.mesh = false;
    SnapshotSeries without(folder.path(), 0);
    state.snapshots_written = 0;
    without.write(scene, state, {}, {});
    EXPECT_THAT(read_text(folder / "run.xdmf"), Not(HasSubstr("Name=\"terrain\"")));
}

}  // namespace
}  // namespace scree::io
