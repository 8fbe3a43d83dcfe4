// Rasters and trajectories of a scenario: which cells, and what is said when there can be none.
#include <gmock/gmock.h>

#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

using testing::build_good;
using ::testing::ElementsAre;
using testing::expect_error;
using testing::kHead;
using testing::TemporaryFolder;

// Nodes at 1005, 1015, ... 1045 and 2005, ... 2035.
constexpr const char* kGrid =
    "ncols 5\nnrows 4\nxllcorner 1000\nyllcorner 2000\ncellsize 10\n"
    "31 32 33 34 35\n21 22 23 24 25\n11 12 13 14 15\n1 2 3 4 5\n";
constexpr const char* kGround = "walls:\n  - {shape: terrain, name: ground, material: steel, path: g.asc}\n";

struct Files {
    TemporaryFolder folder;
    Files() { folder.write("g.asc", kGrid); }
    Scene scene(const std::string& text) const {
        return build_good(kHead + "origin: [1000, 2000, 5]\n" + text, folder.path()).scene;
    }
    void refused(const std::string& text, const std::vector<std::string>& parts) const {
        expect_error(kHead + "origin: [0, 0, 0]\n" + text, parts, folder.path());
    }
};

void expect_grid(const RasterGrid& grid, std::uint32_t columns, std::uint32_t rows, double x, double y, double size) {
    EXPECT_EQ(grid.columns, columns);
    EXPECT_EQ(grid.rows, rows);
    EXPECT_DOUBLE_EQ(grid.x, x);
    EXPECT_DOUBLE_EQ(grid.y, y);
    EXPECT_DOUBLE_EQ(grid.dx, size);
    EXPECT_DOUBLE_EQ(grid.dy, size);
}

TEST(RasterScenario, CellsAreAboutTheNodesOfTheTerrain) {
    const Files files;
    const RasterSettings all = *files.scene(std::string(kGround) + "rasters: {}\n").rasters;
    expect_grid(all.grid, 5, 4, 0.0, 0.0, 10.0);
    EXPECT_EQ(all.terrain, WallIndex{0});
    EXPECT_EQ(all.sample_every, 10U);
    EXPECT_EQ(all.solid_fraction, 1.0);
    EXPECT_EQ(all.covered, 0.0);
    EXPECT_FALSE(all.at_snapshots);
    // Cells whose centre is inside.
    const RasterSettings part = *files
                                     .scene(std::string(kGround) +
                                            "rasters: {lower: [1014, 2015], upper: [1036, 2034], interval: 5 ms, "
                                            "solid_fraction: 0.6, covered: 2 cm, at_snapshots: true}\n")
                                     .rasters;
    expect_grid(part.grid, 3, 2, 10.0, 10.0, 10.0);
    EXPECT_EQ(part.sample_every, 5U);
    EXPECT_EQ(part.solid_fraction, 0.6);
    EXPECT_EQ(part.covered, 0.02);
    EXPECT_TRUE(part.at_snapshots);
}

TEST(RasterScenario, CellsOfAnotherSize) {
    const Files files;
    const RasterSettings fine = *files.scene(std::string(kGround) + "rasters: {terrain: ground, cell: 4}\n").rasters;
    expect_grid(fine.grid, 10, 8, 5.0, 5.0, 4.0);
    const RasterSettings level =
        *files.scene("rasters: {cell: 0.1, lower: [1000, 2000], upper: [1000.3, 2000.65], level: 2}\n").rasters;
    expect_grid(level.grid, 3, 7, 0.0, 0.0, 0.1);
    EXPECT_FALSE(level.terrain);
    EXPECT_EQ(level.level, -3.0);  // below the origin
    EXPECT_FALSE(files.scene("").rasters);
}

TEST(RasterScenario, WhatCannotBeIsRefused) {
    const Files files;
    const std::string two = std::string(kGround) + "  - {shape: terrain, name: other, material: steel, path: g.asc}\n";
    files.refused("rasters: {}\n", {"rasters", "need `cell`, `lower` and `upper`"});
    files.refused("rasters: {cell: 1, lower: [0, 0]}\n", {"need `cell`, `lower` and `upper`"});
    files.refused(two + "rasters: {}\n", {"without one terrain made of a grid"});
    EXPECT_EQ(files.scene(two + "rasters: {terrain: other}\n").rasters->terrain, WallIndex{1});
    files.refused(std::string(kGround) + "rasters: {terrain: grond}\n", {"grond", "ground"});
    files.refused(
        "walls:\n  - {shape: plane, name: floor, material: steel, point: [0, 0, 0], normal: [0, 0, 1]}\n"
        "rasters: {terrain: floor}\n",
        {"rasters need terrain from a grid of heights"});
    files.refused("rasters: {cell: 1, lower: [0, 0], upper: [0, 5]}\n", {"there are no cells"});
    files.refused("rasters: {cell: 1e-6, lower: [0, 0], upper: [5, 5]}\n", {"more than 1e+10"});
    files.refused(std::string(kGround) + "rasters: {lower: [1046, 2000]}\n", {"there are no cells"});
    files.refused(std::string(kGround) + "rasters: {solid_fraction: 1.2}\n", {"solid_fraction"});
}

TEST(TrajectoryScenario, NamesBodiesOrTheirNumber) {
    const Files files;
    EXPECT_FALSE(files.scene("").trajectories.any());
    const TrajectorySettings ids = files.scene("trajectories: {ids: [7, 3, 7], interval: 10 ms}\n").trajectories;
    EXPECT_THAT(ids.ids, ElementsAre(3, 7));
    EXPECT_EQ(ids.every, 10U);
    const TrajectorySettings count = files.scene("trajectories: {count: 12}\n").trajectories;
    EXPECT_EQ(count.count, 12U);
    EXPECT_EQ(count.every, 1U);
    files.refused("trajectories: {}\n", {"trajectories", "ids", "count"});
    files.refused("trajectories: {ids: [1], count: 2}\n", {"ids", "count"});
    files.refused("trajectories: {ids: [-1]}\n", {"ids"});
}

}  // namespace
}  // namespace scree
