#include <chrono>

#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

using testing::build_good;
using testing::expect_error;
using testing::kHead;
using testing::TemporaryFolder;

std::string from_file(const std::string& more) {
    return kHead + "bodies:\n  - {generator: file, path: bodies.txt" + more + "}\n";
}

TEST(BodyFile, ReadsPositionsAndRadii) {
    const TemporaryFolder folder;
    folder.write("bodies.txt",
                 "# x y z r\n"
                 "\n"
                 "1 2 3 0.5   # the first\n"
                 "\t-1.5e0  +2.25 3e-1 0.25\r\n"
                 "4 5 6 1");
    const Bodies b = build_good(from_file(", material: glass"), folder.path()).state.bodies;
    ASSERT_EQ(b.size(), 3U);
    EXPECT_EQ(b.position[0], Vec3(1, 2, 3));
    EXPECT_EQ(b.position[1], Vec3(-1.5, 2.25, 0.3));
    EXPECT_EQ(b.radius, (std::vector<double>{0.5, 0.25, 1.0}));
    EXPECT_EQ(b.spin.size(), 3U);
}

TEST(BodyFile, ReadsTheColumnsThatTheScenarioNames) {
    const TemporaryFolder folder;
    folder.write("bodies.txt", "17 steel 1000 2000 3000 500 1 2 3 4 5 6\n18 glass 0 0 0 500 0 0 0 0 0 0\n");
    const Bodies b =
        build_good(
            from_file(
                ", columns: [skip, material, x, y, z, d, vx, vy, vz, wx, wy, wz], scale: 0.001, offset: [1, 1, 1]"),
            folder.path())
            .state.bodies;
    ASSERT_EQ(b.size(), 2U);
    ASSERT_EQ(b.spin.size(), 2U);  // two bodies with friction can meet
    EXPECT_TRUE(b.position[0].isApprox(Vec3(2, 3, 4)));
    EXPECT_DOUBLE_EQ(b.radius[0], 0.25);
    EXPECT_EQ(b.velocity[0], Vec3(1, 2, 3));
    EXPECT_EQ(b.spin[0], Vec3(4, 5, 6));
    EXPECT_DOUBLE_EQ(b.mass[0], Bodies::sphere_mass(0.25, 7800));
}

TEST(BodyFile, FaultsNameFileLineAndColumn) {
    const TemporaryFolder folder;
    folder.write("bodies.txt",
                 "1 2 3 0.5\n"
                 "1 2 3\n"
                 "1 2 x3 0.5\n"
                 "1 2 3 -0.5\n"
                 "1 2 3 0.5 9\n"
                 "1 2 nan 0.5\n"
                 "1 2 3 0.5e999\n");
    expect_error(
        from_file(", material: glass"),
        {"bodies.txt:2:1: error: 3 columns, expected 4 (x y z r)", "bodies.txt:3:5: error: 'x3' is not a finite number",
         "bodies.txt:4:7: error: the radius must be above 0", "bodies.txt:5:1: error: 5 columns",
         "bodies.txt:6:5: error: 'nan'", "bodies.txt:7:7: error: '0.5e999'", "1 2 x3 0.5"},
        folder.path());
}

TEST(BodyFile, UnknownMaterialsAreNamedWithTheNearest) {
    const TemporaryFolder folder;
    folder.write("bodies.txt", "1 2 3 0.5 glas\n");
    expect_error(from_file(", columns: [x, y, z, r, material]"),
                 {"bodies.txt:1:11: error: there is no material 'glas' (did you mean 'glass'?)"}, folder.path());
}

TEST(BodyFile, AFloodOfFaultsIsCutShort) {
    const TemporaryFolder folder;
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "nothing\n";
    folder.write("bodies.txt", text);
    const std::string errors = testing::build_text(from_file(", material: glass"), folder.path()).errors;
    EXPECT_NE(errors.find("further faults"), std::string::npos);
    EXPECT_EQ(errors.find("bodies.txt:30:"), std::string::npos);
}

TEST(BodyFile, WrongColumnsAreErrors) {
    const TemporaryFolder folder;
    folder.write("bodies.txt", "1 2 3 0.5\n");
    expect_error(from_file(", material: glass, columns: [x, y, r]"), {"must name x, y and z"}, folder.path());
    expect_error(from_file(", material: glass, columns: [x, y, z]"), {"one of r (radius) and d"}, folder.path());
    expect_error(from_file(", material: glass, columns: [x, y, z, r, d]"), {"one of r (radius) and d"}, folder.path());
    expect_error(from_file(", material: glass, columns: [x, y, z, r, x]"), {"'x' is given twice"}, folder.path());
    expect_error(from_file(", columns: [x, y, z, r]"), {"no material"}, folder.path());
    expect_error(from_file(""), {"material"}, folder.path());
    expect_error(from_file(", material: glass, columns: [x, y, z, r, material]"), {"and so does the key"},
                 folder.path());
}

TEST(BodyFile, MissingAndEmptyFilesAreErrors) {
    const TemporaryFolder folder;
    expect_error(from_file(", material: glass"), {"test.yaml:7", "bodies.txt"}, folder.path());
    folder.write("bodies.txt", "# nothing\n");
    expect_error(from_file(", material: glass"), {"holds no bodies"}, folder.path());
    std::filesystem::remove(folder.path() + "/bodies.txt");
    std::filesystem::create_directory(folder.path() + "/bodies.txt");
    expect_error(from_file(", material: glass"), {"bodies.txt"}, folder.path());
}

TEST(BodyFile, AHundredThousandLinesAreReadInUnderASecond) {
    const TemporaryFolder folder;
    std::string text;
    for (int i = 0; i < 100000; ++i) text += std::to_string(i) + ".125 0.333333333333 -1e-3 0.49\n";
    folder.write("bodies.txt", text);
    const auto start = std::chrono::steady_clock::now();
    const Bodies b = build_good(from_file(", material: glass"), folder.path()).state.bodies;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_EQ(b.size(), 100000U);
    EXPECT_LT(seconds, 1.0);
}

}  // namespace
}  // namespace scree
