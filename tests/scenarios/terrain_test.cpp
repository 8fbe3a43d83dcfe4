// Walls of shape terrain: what is built from grids and meshes, and what is said when it cannot be.
#include <fmt/format.h>

#include "contact/walls/wall_contact.hpp"
#include "core/terrain.hpp"
#include "io/atomic_file.hpp"
#include "io/terrain/gzip.hpp"
#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

using testing::build_good;
using testing::expect_error;
using testing::kHead;
using testing::TemporaryFolder;

constexpr const char* kGrid =
    "ncols 5\nnrows 4\nxllcorner 1000\nyllcorner 2000\ncellsize 10\nNODATA_value -9999\n"
    "31 32 33 34 35\n21 22 -9999 24 25\n11 12 13 14 15\n1 2 3 4 5\n";

std::string wall(const std::string& more, const std::string& path = "g.asc") {
    return "walls:\n  - {shape: terrain, name: t, material: steel, path: " + path + (more.empty() ? "" : ", ") + more +
           "}\n";
}

struct Files {
    TemporaryFolder folder;

    Files() {
        folder.write("g.asc", kGrid);
        folder.write("g.asc.gz", io::gzip(kGrid));
        folder.write("G.ASC", kGrid);
    }
    Terrain terrain(const std::string& more, const std::string& path = "g.asc") const {
        const scenarios::Built built = build_good(kHead + "origin: [0, 0, 0]\n" + wall(more, path), folder.path());
        return *std::get<TerrainWall>(built.scene.walls.at(0).shape).terrain;
    }
    void refused(const std::string& more, const std::vector<std::string>& parts,
                 const std::string& path = "g.asc") const {
        expect_error(kHead + wall(more, path), parts, folder.path());
    }
};

TEST(TerrainScenario, AGridOfHeights) {
    const Files files;
    for (const char* path : {"g.asc", "g.asc.gz", "G.ASC"}) {
        const Terrain t = files.terrain("", path);
        EXPECT_EQ(t.ground, 8U * 2 + 4);  // 12 cells, four of them with a triangle only
        EXPECT_EQ(t.lower, Vec3(1005, 2005, 1));
        EXPECT_EQ(t.upper, Vec3(1045, 2035, 35));
        EXPECT_EQ(t.border, TerrainBorder::open);
        EXPECT_EQ(t.grid->columns, 5U);
        EXPECT_EQ(t.grid->at(1, 0), 2.0);
        EXPECT_FALSE(t.grid->has(2, 2));
    }
    EXPECT_EQ(files.terrain("border: closed").border, TerrainBorder::closed);
    const Terrain filled = files.terrain("fill_nodata: 23");
    EXPECT_EQ(filled.ground, 24U);
    EXPECT_EQ(filled.grid->at(2, 2), 23.0);
}

TEST(TerrainScenario, PartsAndScales) {
    const Files files;
    Terrain t = files.terrain("crop: [1015, 2000, 1036, 2026]");
    EXPECT_EQ(t.lower, Vec3(1015, 2005, 2));
    EXPECT_EQ(t.upper, Vec3(1035, 2025, 24));
    t = files.terrain("stride: 2");
    EXPECT_EQ(t.grid->columns, 3U);
    EXPECT_EQ(t.grid->rows, 2U);
    EXPECT_EQ(t.grid->at(2, 0), 5.0);
    EXPECT_EQ(t.grid->at(0, 1), 21.0);
    EXPECT_FALSE(t.grid->has(1, 1));
    EXPECT_EQ(t.grid->dx, 20.0);
    t = files.terrain("stride: 2, crop: [1015, 2005, 1045, 2035]");
    EXPECT_EQ(t.grid->at(0, 0), 2.0);
    EXPECT_EQ(t.grid->at(1, 0), 4.0);
    EXPECT_EQ(t.grid->columns, 2U);
    t = files.terrain("scale: 0.5, offset: [1, 2, 3]");
    EXPECT_EQ(t.lower, Vec3(503.5, 1004.5, 3.5));
    EXPECT_EQ(t.upper, Vec3(523.5, 1019.5, 20.5));
    t = files.terrain("cell: [74.5 m, 92.5 m], offset: [10, 20, 0], crop: [1015, 2005, 1045, 2035]");
    EXPECT_EQ(t.lower, Vec3(84.5, 20, 2));
    EXPECT_EQ(t.grid->dx, 74.5);
    EXPECT_EQ(t.grid->dy, 92.5);
    EXPECT_EQ(t.upper, Vec3(10 + 4 * 74.5, 20 + 3 * 92.5, 35));
    t = files.terrain("cell: [2, 3], stride: 3");
    EXPECT_EQ(t.grid->dx, 6.0);
    EXPECT_EQ(t.upper.y(), 9.0);
}

// A grid of a national system: what is near is near to the last bit.
TEST(TerrainScenario, TheOriginIsNearTheTerrain) {
    const TemporaryFolder folder;
    const auto grid = [](double x, double y, double z) {
        return fmt::format("ncols 3\nnrows 3\nxllcenter {}\nyllcenter {}\ncellsize 500\n{} {} {}\n{} {} {}\n{} {} {}\n",
                           x, y, z, z + 1, z + 4, z, z + 1, z + 4, z, z + 1, z + 4);
    };
    folder.write("near.asc", grid(0, 0, 0));
    folder.write("far.asc", grid(538500, 5576504, 2000));
    const auto built = [&](const char* path, const Vec3& at) {
        return build_good(
            kHead + wall("", path) +
                fmt::format("bodies:\n  - {{generator: sphere, material: glass, radius: 1, position: [{}, {}, {}]}}\n",
                            at.x(), at.y(), at.z()),
            folder.path());
    };
    const Vec3 shift(538500, 5576504, 2000), at(321, 654, 3);
    const scenarios::Built here = built("near.asc", at), there = built("far.asc", at + shift);
    EXPECT_EQ(here.scene.origin, Vec3::Zero());
    EXPECT_GT(there.scene.origin.y(), 5.5e6);
    const Vec3 back = there.scene.origin - shift;
    EXPECT_EQ(there.state.bodies.position[0] + back, at);
    const Terrain &a = *std::get<TerrainWall>(here.scene.walls[0].shape).terrain,
                  &b = *std::get<TerrainWall>(there.scene.walls[0].shape).terrain;
    ASSERT_EQ(a.mesh.vertex.size(), b.mesh.vertex.size());
    for (std::size_t i = 0; i < a.mesh.vertex.size(); ++i) EXPECT_EQ(b.mesh.vertex[i] + back, a.mesh.vertex[i]);
}

TEST(TerrainScenario, Meshes) {
    const Files files;
    files.folder.write("m.off", "OFF\n4 1 0\n0 0 0\n10 0 1\n10 10 2\n0 10 1\n4 0 1 2 3\n");
    files.folder.write("m.obj", "v 0 0 0\nv 10 0 1\nv 10 10 2\nv 0 10 1\nf 1 2 3 4\n");
    files.folder.write(
        "m.stl",
        "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 1\nvertex 10 10 2\nendloop\n"
        "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 10 2\nvertex 0 10 1\nendloop\n"
        "endfacet\nendsolid\n");
    for (const char* path : {"m.off", "m.obj", "m.stl"}) {
        const Terrain t = files.terrain("scale: 0.1, offset: [5, 0, 0]", path);
        EXPECT_EQ(t.ground, 2U);
        EXPECT_EQ(t.mesh.triangle.size(), 2U + 8U);
        EXPECT_LT((t.upper - Vec3(6, 1, 0.2)).norm(), 1e-15);
        EXPECT_FALSE(t.grid);
    }
    files.refused("crop: [0, 0, 1, 1]", {"walls[0].crop: is for grids of heights"}, "m.off");
    files.refused("stride: 2", {"walls[0].stride: is for grids of heights"}, "m.off");
    files.folder.write("two.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 1 3\n");
    files.refused("", {"'two.off' is no terrain", "an edge in the same direction"}, "two.off");
    files.folder.write("none.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 0 0\n3 0 1 2\n");
    files.refused("", {"holds no face with an area"}, "none.off");
    files.folder.write("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 x\n");
    files.refused("", {"bad.off:4"}, "bad.off");
}

TEST(TerrainScenario, Zones) {
    const Files files;
    const Terrain t = files.terrain(
        "fill_nodata: 23, zones: [{material: glass, polygon: [[1000, 2000], [1025, 2000], [1025, 2040], [1000, "
        "2040]]},\n"
        "   {material: steel, polygon: [[1000, 2000], [1015, 2000], [1015, 2015], [1000, 2015]]}]");
    ASSERT_EQ(t.material.size(), t.mesh.triangle.size());
    int glass = 0;
    for (std::uint32_t k = 0; k < t.mesh.triangle.size(); ++k) {
        const auto& c = t.mesh.triangle[k].corner;
        const Vec3 middle = (t.mesh.vertex[c[0]] + t.mesh.vertex[c[1]] + t.mesh.vertex[c[2]]) / 3.0;
        const bool first = middle.x() < 1025 && k < t.ground, second = middle.x() < 1015 && middle.y() < 2015;
        ASSERT_EQ(t.material[k], MaterialIndex{static_cast<std::uint16_t>(first && !second ? 0 : 1)}) << k;
        glass += first && !second ? 1 : 0;
    }
    EXPECT_EQ(glass, 10);
    EXPECT_TRUE(files.terrain("").material.empty());
    files.refused("zones: [{material: glass, polygon: [[0, 0], [1, 1]]}]",
                  {"walls[0].zones[0].polygon: ", "three corners"});
    files.refused("zones: [{material: glas, polygon: [[0, 0], [1, 1], [0, 1]]}]",
                  {"walls[0].zones[0].material", "did you mean 'glass'"});
    const testing::Result far = testing::build_text(
        kHead + wall("zones: [{material: glass, polygon: [[0, 0], [1, 1], [0, 1]]}]"), files.folder.path());
    EXPECT_NE(far.warnings.find("no triangle of the terrain lies in this zone"), std::string::npos);
}

TEST(TerrainScenario, WrongOnesAreRefused) {
    const Files files;
    files.refused("", {"test.yaml:7:", "walls[0].path: ", "none.asc", "cannot be opened"}, "none.asc");
    files.refused("", {"walls[0].path: what '", "x.tif' is cannot be told from its name; .asc, .asc.gz"}, "x.tif");
    files.folder.write("short.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n4 5\n");
    files.refused("", {"short.asc:7:1: error: 2 heights on this line; 3 are expected"}, "short.asc");
    files.folder.write("cut.asc.gz", io::gzip(kGrid).substr(0, 60));
    files.refused("", {"walls[0].path: ", "cut.asc.gz: the gzip data ends too early"}, "cut.asc.gz");
    files.folder.write("empty.asc",
                       "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n-9999 -9999\n-9999 -9999\n");
    files.refused("", {"has no heights here: every node is without data"}, "empty.asc");
    files.folder.write("sparse.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 -9999\n-9999 1\n");
    files.refused("", {"'sparse.asc' is no terrain: there is no triangle in it"}, "sparse.asc");
    files.refused("crop: [1011, 0, 1019, 9999]",
                  {"walls[0].crop: ", "1 x 4 nodes are left", "[1005, 2005] to [1045, 2035]"});
    files.refused("crop: [9, 9, 10, 10]", {"walls[0].crop: 0 x 0 nodes"});
    files.refused("stride: 4", {"walls[0].stride: 2 x 1 nodes are left"});
    files.refused("motion: {rate: 1}", {"walls[0].motion: a terrain does not move"});
    files.refused("border: shut", {"walls[0].border: 'shut'", "one of open, closed"});
    files.refused("crop: [1, 2, 3]", {"walls[0].crop: a list of 3; expected a list of 4 numbers"});
    files.refused("cell: [1, 0]", {"walls[0].cell[1]"});
    files.refused("cell: [1 kg, 1]", {"walls[0].cell[0]"});
    files.refused("stride: 0", {"walls[0].stride"});
    files.refused("scale: 0", {"walls[0].scale"});
    files.refused("", {"walls[0].path: "}, ".");
    files.refused("checksum: abc", {"walls[0].checksum: '", "g.asc' is not the file that is meant", "abc is expected"});
    // the rest of the scenario is looked at too
    expect_error(
        kHead + wall("", "none.asc") +
            "bodies:\n  - {generator: random, material: glass, size: {distribution: fixed, diameter: 1}, count: 2,\n"
            "     region: {shape: box, lower: [0, 0, 0], upper: [9, 9, 0.5]}}\n",
        {"none.asc", "too large for the region"}, files.folder.path());
}

TEST(TerrainScenario, RandomBodiesKeepClearOfIt) {
    const Files files;
    const scenarios::Built built =
        build_good(kHead + wall("fill_nodata: 23") +
                       "bodies:\n  - {generator: random, material: glass, size: {distribution: uniform, lower: 1, "
                       "upper: 4}, count: 300,\n"
                       "     region: {shape: box, lower: [1005, 2005, -20], upper: [1045, 2035, 45]}}\n",
                   files.folder.path());
    const Terrain& terrain = *std::get<TerrainWall>(built.scene.walls[0].shape).terrain;
    ASSERT_EQ(built.state.bodies.size(), 300U);
    for (std::size_t i = 0; i < 300; ++i) {
        contact::WallContacts found;
        contact::find_contacts(built.scene.walls[0].shape, built.state.bodies.position[i], built.state.bodies.radius[i],
                               0.0, found);
        EXPECT_EQ(found.count, 0);
        EXPECT_FALSE(terrain.under(built.state.bodies.position[i]));
    }
}

}  // namespace
}  // namespace scree
