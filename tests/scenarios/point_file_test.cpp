// Blocks from a file of points.
#include "scenarios/point_file.hpp"

#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

using testing::build_good;
using testing::expect_error;
using testing::kHead;
using testing::TemporaryFolder;

std::string hulls(const std::string& more = "") {
    return kHead + "bodies:\n  - {generator: hulls, material: glass, path: points.txt" + more + "}\n";
}
const std::string kTetrahedron = "0 0 0\n4 0 0\n0 4 0\n0 0 4\n";
const std::string kCube = "10 0 0\n11 0 0\n11 1 0\n10 1 0\n10 0 1\n11 0 1\n11 1 1\n10 1 1\n10.5 0.5 0.5\n";

TEST(PointFile, EachBlockIsTheHullOfItsPointsWhereTheyAre) {
    const TemporaryFolder folder;
    folder.write("points.txt", "# two blocks\n\n" + kTetrahedron + "  # the corner\n  \t\n\n" + kCube);
    const auto built = build_good(hulls(), folder.path());
    const Bodies& b = built.state.bodies;
    ASSERT_EQ(b.size(), 2U);
    EXPECT_TRUE(b.position[0].isApprox(Vec3(1, 1, 1), 1e-14));
    EXPECT_TRUE(b.position[1].isApprox(Vec3(10.5, 0.5, 0.5), 1e-14));
    EXPECT_NEAR(b.mass[0], 2500.0 * 64.0 / 6.0, 1e-9);
    EXPECT_NEAR(b.mass[1], 2500.0, 1e-9);
    EXPECT_EQ(built.state.shapes[1].vertex.size(), 8U);
    const Bodies mm =
        build_good(hulls(", scale: 0.001, offset: [1, 0, 0], velocity: [0, 0, 3]"), folder.path()).state.bodies;
    EXPECT_TRUE(mm.position[0].isApprox(Vec3(1.001, 0.001, 0.001), 1e-14));
    EXPECT_EQ(mm.velocity[1], Vec3(0, 0, 3));
}

TEST(PointFile, LargeCoordinatesCostNoDigits) {
    const TemporaryFolder folder;
    folder.write("points.txt", "600000 0 0\n600004 0 0\n600000 4 0\n600000 0 4\n");
    const auto built = build_good(hulls(", offset: [0.25, 0, 0]"), folder.path());
    EXPECT_GT(built.scene.origin.x(), 599000.0);
    EXPECT_NEAR((built.scene.origin.x() - 600001.25) + built.state.bodies.position[0].x(), 0.0, 1e-9);
    EXPECT_NEAR(built.state.shapes[0].volume, 64.0 / 6.0, 1e-8);
}

TEST(PointFile, FaultsHaveTheirLine) {
    const TemporaryFolder folder;
    const auto wrong = [&](const std::string& text, const std::vector<std::string>& parts) {
        folder.write("points.txt", text);
        expect_error(hulls(), parts, folder.path());
    };
    wrong("0 0 0\n1 x 0\n", {"points.txt:2:3: error: 'x' is not a finite number"});
    wrong("0 0 nan\n", {"points.txt:1:5: error: 'nan' is not a finite number"});
    wrong("0 0 0\n1 2\n1 2 3 4\n", {"points.txt:2:1: error: 2 numbers, expected 3 (x y z)",
                                    "points.txt:3:1: error: 4 numbers, expected 3 (x y z)"});
    wrong("# nothing\n", {"test.yaml:7:47: error: bodies[0].path: ", "holds no points"});
    wrong(kTetrahedron + "\n0 0 0\n1 0 0\n2 0 0\n3 1 0\n", {"points.txt:6:1: error: "});
    std::filesystem::remove(folder.path() + "/points.txt");
    expect_error(hulls(), {"test.yaml:7:47: error: bodies[0].path: cannot read '"}, folder.path());
}

}  // namespace
}  // namespace scree
