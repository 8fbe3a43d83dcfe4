// Bodies made in parts: together they are those that one rank makes, to the bit.
#include "tests/scenarios/support.hpp"

namespace scree {
namespace {

const std::string kSize = "size: {distribution: uniform, lower: 0.05, upper: 0.1}";

testing::Result build_on(const std::string& text, const std::string& folder, const Communicator& ranks) {
    io::Diagnostics diagnostics;
    const io::ReadResult read = io::read_scenario_text(text, folder + "/test.yaml", {}, diagnostics);
    testing::Result result;
    if (!diagnostics.has_errors()) result.built = scenarios::build(read.root, folder, diagnostics, ranks);
    result.errors = diagnostics.report();
    result.warnings = diagnostics.warnings();
    return result;
}

// Each body of this rank is one of the whole, with the same numbers, and no body is missing or made twice.
void expect_parts_of(const State& whole, const State& part, const Communicator& ranks) {
    const Bodies &a = whole.bodies, &b = part.bodies;
    std::uint64_t id_sum = 0, expected_sum = 0;
    for (const BodyId id : a.id) expected_sum += mix64(raw(id));
    for (std::size_t i = 0; i < b.size(); ++i) {
        EXPECT_TRUE(i == 0 || raw(b.id[i - 1]) < raw(b.id[i]));
        id_sum += mix64(raw(b.id[i]));
        const auto k = static_cast<std::size_t>(raw(b.id[i]));  // ids of the whole count from 0
        ASSERT_LT(k, a.size());
        EXPECT_EQ(a.radius[k], b.radius[i]);
        EXPECT_EQ(a.mass[k], b.mass[i]);
        EXPECT_EQ(a.material[k], b.material[i]);
        EXPECT_EQ(a.position[k], b.position[i]);
        EXPECT_EQ(a.velocity[k], b.velocity[i]);
        EXPECT_TRUE(!b.has_spin() || a.spin[k] == b.spin[i]);
        EXPECT_TRUE(!b.has_shapes() || a.shape[k] == b.shape[i]);
        EXPECT_TRUE(!b.has_shapes() || a.inertia[k] == b.inertia[i]);
        EXPECT_TRUE(!b.has_orientation() || a.orientation[k].coeffs() == b.orientation[i].coeffs());
    }
    EXPECT_EQ(ranks.sum(static_cast<std::uint64_t>(b.size())), a.size());
    EXPECT_EQ(ranks.sum(id_sum), expected_sum);
    EXPECT_EQ(whole.next_id, part.next_id);
    EXPECT_EQ(ranks.any(b.has_spin()), a.has_spin());
    EXPECT_EQ(ranks.any(b.has_shapes()), a.has_shapes());
    ASSERT_EQ(whole.shapes.size(), part.shapes.size());
    for (std::size_t s = 0; s < whole.shapes.size(); ++s) {
        EXPECT_EQ(whole.shapes[s].vertex, part.shapes[s].vertex);
        EXPECT_EQ(whole.shapes[s].volume, part.shapes[s].volume);
    }
}

void expect_same_on_all_ranks(const std::string& bodies, const std::string& folder = ".",
                              const std::string& shapes = "") {
    const Communicator ranks = Communicator::world();
    const std::string text = testing::kHead + shapes + "bodies:\n" + bodies;
    const testing::Result whole = build_on(text, folder, Communicator::self());
    const testing::Result part = build_on(text, folder, ranks);
    EXPECT_EQ(whole.errors, part.errors);
    EXPECT_EQ(whole.warnings, part.warnings);
    EXPECT_EQ(whole.built.scene.origin, part.built.scene.origin);
    if (whole.errors.empty()) expect_parts_of(whole.built.state, part.built.state, ranks);
}

std::string lattice(const std::string& more) {
    return "  - {generator: lattice, material: glass, corner: [0, 0, 0], pitch: 0.2, jitter: 0.01, " + kSize + ", " +
           more + "}\n";
}

TEST(Parts, Lattice) {
    expect_same_on_all_ranks(lattice("cells: [7, 5, 3]"));
    expect_same_on_all_ranks(lattice("cells: [7, 5, 3], count: 40, arrangement: hexagonal"));
    expect_same_on_all_ranks(lattice("cells: [1, 1, 1]"));
}

TEST(Parts, LatticeInAClip) {
    const std::string clip = "clip: {shape: sphere, centre: [0.7, 0.5, 0.3], radius: 0.4}";
    expect_same_on_all_ranks(lattice("cells: [9, 9, 9], " + clip));
    expect_same_on_all_ranks(lattice("cells: [9, 9, 9], count: 11, " + clip));
    expect_same_on_all_ranks(lattice("cells: [9, 9, 9], count: 700, " + clip));  // too few places: an error
}

TEST(Parts, SpheresAndLatticesTogether) {
    std::string text;
    for (int i = 0; i < 7; ++i)
        text += "  - {generator: sphere, material: steel, radius: 0.1, position: [" + std::to_string(i) + ", 5, 5]}\n";
    expect_same_on_all_ranks(text + lattice("cells: [4, 4, 4]") + text);
}

TEST(Parts, RandomPlacesKeepClearOfAllBodiesBefore) {
    const std::string random = "  - {generator: random, material: steel, " + kSize +
                               ", count: 60, region: {shape: box, lower: [0, 0, 0], upper: [1, 1, 1]}}\n";
    expect_same_on_all_ranks(lattice("cells: [4, 4, 4]") + random + lattice("cells: [3, 3, 3], velocity: [0, 0, 1]"));
}

TEST(Parts, Files) {
    const Communicator ranks = Communicator::world();
    const testing::TemporaryFolder folder;  // one a rank; only that of rank 0 is read
    std::string lines = "# a bed far away\n\n";
    for (int i = 0; i < 1000; ++i)
        lines += std::to_string(500000 + i % 10) + ".25 " + std::to_string(5000000 + i / 10 % 10) + " " +
                 std::to_string(i / 100) + ".5 0.25" + (i % 7 == 0 ? "  # a remark\n" : "\n");
    folder.write("bed.txt", lines);
    std::string path = folder.path();
    ranks.broadcast(path);
    const std::string file = "  - {generator: file, material: glass, path: bed.txt, offset: [0.5, 0, 0]}\n";
    expect_same_on_all_ranks(file, path);
    expect_same_on_all_ranks(file + lattice("cells: [2, 2, 2]") + file, path);
    if (ranks.root()) folder.write("bed.txt", lines + "1 2 3\n1 2 x 3\n");
    ranks.barrier();
    expect_same_on_all_ranks(file, path);
    ranks.barrier();
}

const std::string kShapes =
    "shapes:\n"
    "  - {name: stone, kind: rock, diameter: 0.1, variants: 6}\n"
    "  - {name: brick, kind: box, size: [0.15, 0.1, 0.05]}\n";

TEST(Parts, Polyhedra) {
    const std::string one =
        "  - {generator: polyhedron, shape: stone, material: steel, position: [5, 5, 5], "
        "orientation: {random: true}, scale: 1.5}\n";
    const std::string random = "  - {generator: random, material: steel, " + kSize +
                               ", count: 60, region: {shape: box, lower: [0, 0, 2], upper: [2, 2, 4]}, shape: brick, "
                               "orientation: {random: true}}\n";
    const std::string stones = lattice("cells: [7, 5, 3], shape: stone, orientation: {random: true}");
    expect_same_on_all_ranks(stones, ".", kShapes);
    expect_same_on_all_ranks(one + stones + one + random + lattice("cells: [3, 3, 3]") + one, ".", kShapes);
    // two bodies of 6 x 20 possible shapes, on different ranks
    expect_same_on_all_ranks(lattice("cells: [2, 1, 1], shape: stone"), ".", kShapes);
}

TEST(Parts, Blocks) {
    const std::string voronoi =
        "  - {generator: voronoi, material: glass, region: {shape: box, lower: [0, 0, 0], upper: [1, 1, 1]}, count: "
        "23}\n";
    const std::string rock =
        "  - {generator: rock_mass, material: glass, region: {shape: box, lower: [0, 0, 5], upper: [1, 1, 6]}, gap: 1 "
        "mm, "
        "joints: [{dip: 40 deg, spacing: 0.3, angle_scatter: 3 deg}, {dip: 80 deg, dip_direction: 70 deg, spacing: "
        "0.2}]}\n";
    const std::string wall =
        "  - {generator: wall_of_blocks, material: glass, corner: [0, 9, 0], rows: 5, columns: 7, size: [0.4, 0.2, "
        "0.2]}\n";
    const std::string arch =
        "  - {generator: arch, material: steel, centre: [0, 0, 20], count: 4, radius: 3, thickness: 0.5, depth: 1, "
        "spin: "
        "[0, 0, 1]}\n";
    expect_same_on_all_ranks(voronoi + rock + wall + arch);
    expect_same_on_all_ranks(arch + lattice("cells: [3, 3, 3], shape: stone") + rock, ".", kShapes);
}

TEST(Parts, FilesOfPolyhedra) {
    const Communicator ranks = Communicator::world();
    const testing::TemporaryFolder folder;
    std::string lines;
    for (int i = 0; i < 300; ++i)
        lines += std::to_string(i % 10) + " " + std::to_string(i / 10) + " 0 " + (i % 3 == 0 ? "brick" : "stone") +
                 (i % 4 == 0 ? " 0.1\n" : " 0.2\n");
    folder.write("bed.txt", lines);
    folder.write("wedge.off", "OFF\n4 4 0\n0 0 0\n0.2 0 0\n0 0.1 0\n0 0 0.1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    folder.write("open.off", "OFF\n4 1 0\n0 0 0\n0.2 0 0\n0 0.1 0\n0 0 0.1\n3 0 2 1\n");
    folder.write("points.txt", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n\n5 0 0\n6 0 0\n5 1 0\n5 0 1\n5 1 1\n");
    folder.write("plane.txt", "0 0 0\n1 0 0\n0 1 0\n1 1 0\n\n5 0 x\n");
    std::string path = folder.path();
    ranks.broadcast(path);  // all files are written; only rank 0 has this folder
    const std::string file =
        "  - {generator: file, material: glass, path: bed.txt, columns: [x, y, z, shape, d], "
        "orientation: {random: true}}\n";
    expect_same_on_all_ranks(file + file, path, kShapes);
    expect_same_on_all_ranks(lattice("cells: [3, 3, 3], shape: wedge"), path,
                             "shapes:\n  - {name: wedge, kind: file, path: wedge.off}\n");
    for (const char* points : {"points.txt", "plane.txt", "none.txt"})
        expect_same_on_all_ranks(
            std::string("  - {generator: hulls, material: glass, offset: [0, 0, 1], path: ") + points + "}\n", path);
    for (const char* wrong : {"open.off", "none.off"})
        expect_same_on_all_ranks(lattice("cells: [3, 3, 3], shape: wedge"), path,
                                 std::string("shapes:\n  - {name: wedge, kind: file, path: ") + wrong + "}\n");
    ranks.barrier();
}

TEST(Parts, AFileThatIsNotThereIsAnErrorOnAllRanks) {
    expect_same_on_all_ranks("  - {generator: file, material: glass, path: nothing.txt}\n", "/nowhere");
}

TEST(Parts, WhatOnlyOneRankHasCountsForThePlanOfAll) {
    // One rough body on one rank, one wall: friction on all ranks.
    const Communicator ranks = Communicator::world();
    const std::string text =
        testing::kHead +
        "  ice: {density: 900, friction: 0, restitution: 0}\n"
        "bodies:\n" +
        "  - {generator: sphere, material: glass, radius: 0.1, position: [0, 0, 5]}\n"
        "  - {generator: sphere, material: ice, radius: 0.1, position: [0, 1, 5]}\n"
        "walls:\n  - {shape: plane, name: p, material: glass, point: [0, 0, 0], normal: [0, 0, 1]}\n";
    const testing::Result part = build_on(text, ".", ranks);
    EXPECT_EQ(part.errors, "");
    EXPECT_TRUE(make_plan(part.built.scene, part.built.state.bodies, ranks).friction);
    EXPECT_EQ(part.built.state.bodies.spin.size(), part.built.state.bodies.size());
}

}  // namespace
}  // namespace scree
