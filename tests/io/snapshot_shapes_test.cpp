// Snapshots of bodies that are not spheres: shapes beside them, surfaces in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "io/atomic_file.hpp"
#include "io/hdf5/hdf5_file.hpp"
#include "io/results/compare.hpp"
#include "io/results/info.hpp"
#include "io/results/snapshot.hpp"
#include "polyhedra.hpp"

namespace scree::io {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Lt;
using ::testing::Not;
namespace fs = std::filesystem;

std::vector<Vec3> vectors(const Hdf5Group& root, const std::string& name) {
    const std::vector<double> x = read_numbers(root, name);
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < x.size(); i += 3) all.emplace_back(x[i], x[i + 1], x[i + 2]);
    return all;
}

std::string written(const TemporaryFolder& folder, const Scene& scene, State& state) {
    SnapshotSeries series(folder.path(), state.snapshots_written);
    series.write(scene, state, {}, {});
    return list_snapshots(folder.path()).back();
}

TEST(SnapshotShapes, PlaceTheVerticesOfEachBody) {
    const TemporaryFolder folder;
    State state = polyhedra_state(7);
    Scene scene = sample_scene();
    scene.output.fields = {};  // orientation and shape are there all the same
    const Hdf5File file = Hdf5File::open(written(folder, scene, state));
    const Hdf5Group& root = file.root();
    EXPECT_THAT(read_numbers(root, "bodies/shape"), ElementsAre(0, 1, -1, 0, 1, -1, 0));
    const std::vector<Vec3> position = vectors(root, "bodies/position"), vertex = vectors(root, "shapes/vertex");
    const std::vector<double> q = read_numbers(root, "bodies/orientation"), shape = read_numbers(root, "bodies/shape"),
                              count = read_numbers(root, "shapes/vertices");
    const std::vector<Vec3> points = vectors(root, "mesh/points");
    EXPECT_THAT(count, ElementsAre(8, 4, 12));
    std::size_t next = 0;
    for (std::size_t i = 0; i < shape.size(); ++i) {
        if (shape[i] < 0.0) continue;
        std::size_t begin = 0;
        for (std::size_t s = 0; s < static_cast<std::size_t>(shape[i]); ++s)
            begin += static_cast<std::size_t>(count[s]);
        const Quat turn(q[4 * i], q[4 * i + 1], q[4 * i + 2], q[4 * i + 3]);
        for (std::size_t k = 0; k < static_cast<std::size_t>(count[static_cast<std::size_t>(shape[i])]); ++k) {
            EXPECT_LT((position[i] + turn * vertex[begin + k] - points[next++]).norm(), 3e-5);  // single precision
        }
    }
    EXPECT_EQ(next, points.size());
    for (const DatasetInfo& info : root.datasets()) EXPECT_NE(info.description, "") << info.name;
    EXPECT_EQ(root.dataset("mesh/points").type, ElementType::f32);
}

// Every edge is passed once in each direction, and the faces enclose the volume of the bodies.
TEST(SnapshotShapes, TheSurfacesAreClosedAndFaceOutwards) {
    const TemporaryFolder folder;
    State state = polyhedra_state(20);
    const Hdf5File file = Hdf5File::open(written(folder, sample_scene(), state));
    const Hdf5Group& root = file.root();
    const std::vector<Vec3> points = vectors(root, "mesh/points");
    const std::vector<double> cells = read_numbers(root, "mesh/cells"), body = read_numbers(root, "mesh/body");
    std::map<std::pair<std::size_t, std::size_t>, int> directed;
    std::map<std::size_t, double> volume;
    std::size_t at = 0;
    for (const double b : body) {
        ASSERT_EQ(cells[at], 3.0);
        const auto corners = static_cast<std::size_t>(cells[at + 1]);
        const auto corner = [&](std::size_t k) { return static_cast<std::size_t>(cells[at + 2 + k % corners]); };
        const auto i = static_cast<std::size_t>(b);
        const Vec3 centre = state.bodies.position[i] + sample_scene().origin;
        for (std::size_t k = 0; k < corners; ++k) {
            ++directed[{corner(k), corner(k + 1)}];
            const Vec3 x = points[corner(0)] - centre, y = points[corner(k)] - centre,
                       z = points[corner(k + 1)] - centre;
            volume[i] += x.dot(y.cross(z)) / 6.0;
        }
        at += 2 + corners;
    }
    EXPECT_EQ(at, cells.size());
    for (const auto& [edge, times] : directed) {
        EXPECT_EQ(times, 1);
        EXPECT_TRUE(directed.contains({edge.second, edge.first}));
    }
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.is_sphere(i)) {
            EXPECT_FALSE(volume.contains(i));
        } else {
            EXPECT_NEAR(volume[i], state.shapes[raw(state.bodies.shape[i])].volume, 1e-4);
        }
    }
}

TEST(SnapshotShapes, FarFromTheOriginPointsAreDouble) {
    const TemporaryFolder folder;
    Scene scene = sample_scene();
    scene.origin = Vec3(2.6e6, 1.2e6, 1500.0);
    State state = polyhedra_state(1);
    const Hdf5File file = Hdf5File::open(written(folder, scene, state));
    EXPECT_EQ(file.root().dataset("mesh/points").type, ElementType::f64);
    EXPECT_THAT(read_text(folder / "run.xdmf"),
                HasSubstr("Dimensions=\"8 3\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">"
                          "snapshots/000000.h5:/mesh/points"));
}

TEST(SnapshotShapes, WithoutMeshNoMesh) {
    const TemporaryFolder folder;
    Scene scene = sample_scene();
    scene.output.mesh = false;
    State state = polyhedra_state(5);
    const Hdf5File file = Hdf5File::open(written(folder, scene, state));
    EXPECT_FALSE(file.root().has("mesh"));
    EXPECT_THAT(read_text(folder / "run.xdmf"), AllOf(HasSubstr("\"centres\""), Not(HasSubstr("polyhedra\""))));
}

TEST(SnapshotShapes, SpheresAloneHaveNone) {
    const TemporaryFolder folder;
    State state = sample_state(5);
    const Hdf5File file = Hdf5File::open(written(folder, sample_scene(), state));
    for (const char* name : {"mesh", "shapes", "bodies/shape"}) EXPECT_FALSE(file.root().has(name)) << name;
    EXPECT_FALSE(fs::exists(folder / "snapshots/shapes.h5"));
}

TEST(SnapshotShapes, AreThereWhenAllBodiesHaveLeft) {
    const TemporaryFolder folder;
    State state = polyhedra_state(3);
    State gone = polyhedra_state(0);
    gone.shapes = state.shapes;
    const Hdf5File file = Hdf5File::open(written(folder, sample_scene(), gone));
    EXPECT_EQ(file.root().dataset("bodies/shape").shape.at(0), 0U);
    EXPECT_EQ(file.root().dataset("shapes/vertices").shape.at(0), 3U);
    EXPECT_THAT(read_text(folder / "run.xdmf"), Not(HasSubstr("polyhedra\"")));
}

TEST(SnapshotShapes, AreShownAndCompared) {
    const TemporaryFolder one, other;
    State state = polyhedra_state(9), changed = polyhedra_state(9);
    const std::string a = written(one, sample_scene(), state);
    changed.shapes[1].vertex[2].x() += 1e-9;
    const std::string b = written(other, sample_scene(), changed);
    EXPECT_THAT(info(a), AllOf(HasSubstr("shapes/vertex"), HasSubstr("mesh/points"), HasSubstr("bodies/shape")));
    EXPECT_TRUE(compare(a, a).identical);
    const Comparison comparison = compare(a, b, 1e-6);
    EXPECT_FALSE(comparison.identical);
    EXPECT_TRUE(comparison.within);
    // Of folders, what all snapshots share is compared once.
    const std::string text = to_text(compare(one.path(), other.path(), 1e-6));
    EXPECT_THAT(text, AllOf(HasSubstr("shapes.h5: shapes/vertex: 1 of 72 numbers differ"),
                            Not(HasSubstr("000000.h5: shapes/"))));
    // A snapshot alone, without shapes.h5, still opens.
    fs::remove(other / "snapshots/shapes.h5");
    EXPECT_THAT(info(b), Not(HasSubstr("shapes/vertex")));
    EXPECT_FALSE(compare(a, b, 1e-6).within);
}

}  // namespace
}  // namespace scree::io
