// What good scenarios become: values, defaults, includes, overrides, and the resolved text.
#include "io/scenario/scenario_reader.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace scree::io {
namespace {

namespace fs = std::filesystem;

const std::string kBase =
    "scenario_version: 1\n"
    "time: {end: 1, step: 1 ms}\n"
    "materials: {glass: {density: 2.5 g/cm3}}\n";

ReadResult read_good(const std::string& text, const std::vector<std::string>& overrides = {}) {
    Diagnostics diagnostics;
    ReadResult result = read_scenario_text(text, "s.yaml", overrides, diagnostics);
    EXPECT_EQ(diagnostics.report(), "");
    return result;
}

// The same keys, kinds and values; places and who gave them apart.
bool same(const Node& a, const Node& b) {
    if (a.value.index() != b.value.index() || a.path != b.path) return false;
    if (const auto* list = std::get_if<Node::List>(&a.value)) {
        return std::equal(list->begin(), list->end(), b.items().begin(), b.items().end(), same);
    }
    if (const auto* map = std::get_if<Node::Map>(&a.value)) {
        const auto& other = std::get<Node::Map>(b.value);
        return std::equal(map->begin(), map->end(), other.begin(), other.end(),
                          [](const auto& x, const auto& y) { return x.first == y.first && same(x.second, y.second); });
    }
    if (const auto* vector = std::get_if<Vec3>(&a.value)) return *vector == b.vector();
    if (const auto* number = std::get_if<double>(&a.value)) return *number == b.number();
    if (const auto* integer = std::get_if<std::int64_t>(&a.value)) return *integer == b.integer();
    if (const auto* text = std::get_if<std::string>(&a.value)) return *text == b.text();
    return a.boolean() == b.boolean();
}

class Folder : public testing::Test {
  protected:
    Folder() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() / fs::path("scree_reader_" + std::string(info->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "parts");
    }
    ~Folder() override { fs::remove_all(folder_); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return (folder_ / name).string();
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    fs::path folder_;
};
using Includes = Folder;

TEST(ScenarioReader, ValuesAreInSiAndDefaultsAreFilledIn) {
    const Node root = read_good(kBase + "solver: {max_sweeps: 1e3}\n").root;
    EXPECT_EQ(root.at("time").number("step"), 0.001);
    EXPECT_TRUE(root.at("time").at("step").given);
    EXPECT_EQ(root.at("materials").at("glass").number("density"), 2500.0);
    EXPECT_EQ(root.at("materials").at("glass").number("friction"), 0.5);
    EXPECT_FALSE(root.at("materials").at("glass").at("friction").given);
    EXPECT_EQ(root.at("solver").integer("max_sweeps"), 1000);
    EXPECT_TRUE(root.at("solver").boolean("warm_start"));
    EXPECT_EQ(root.at("solver").text("method"), "conjugate_gauss_seidel");
    EXPECT_EQ(root.vector("gravity"), Vec3(0.0, 0.0, -9.81));
    EXPECT_EQ(root.at("walls").size(), 0U);
    EXPECT_FALSE(root.has("origin"));
    EXPECT_EQ(root.at("output").at("fields").at(std::size_t{0}).text(), "velocity");
}

TEST(ScenarioReader, NodesKnowTheirPlace) {
    const Node root = read_good(kBase +
                                "walls:\n- {shape: plane, name: floor, material: glass,\n"
                                "   point: [0, 0, 0], normal: [0, 0, 2]}\n")
                          .root;
    const Node& normal = root.at("walls").at(std::size_t{0}).at("normal");
    EXPECT_EQ(normal.path, "walls[0].normal");
    EXPECT_EQ(normal.mark.file, "s.yaml");
    EXPECT_EQ(normal.mark.line, 6);
    EXPECT_EQ(normal.mark.column, 30);
    EXPECT_EQ(normal.vector(), Vec3(0.0, 0.0, 2.0));
}

TEST(ScenarioReader, OneNumberStandsForThree) {
    const Node root = read_good(kBase +
                                "bodies: [{generator: lattice, material: glass, corner: [0, 0, 0], pitch: 1 cm, "
                                "cells: [1, 2, 3], size: {distribution: fixed, diameter: 9 mm}}]\n")
                          .root;
    const Node& lattice = root.at("bodies").at(std::size_t{0});
    EXPECT_EQ(lattice.vector("pitch"), Vec3(0.01, 0.01, 0.01));
    EXPECT_EQ(lattice.at("cells").at(std::size_t{2}).integer(), 3);
    EXPECT_EQ(lattice.at("size").number("diameter"), 0.009);
}

TEST(ScenarioReader, AnchorsAndMergeKeysWork) {
    const Node root = read_good(kBase +
                                "outlets:\n- &o {name: a, region: &r {shape: sphere, centre: [0, 0, 0], radius: 1}}\n"
                                "- {<<: *o, name: b}\n- {name: c, region: *r}\n")
                          .root;
    EXPECT_EQ(root.at("outlets").at(std::size_t{1}).text("name"), "b");
    EXPECT_EQ(root.at("outlets").at(std::size_t{1}).at("region").number("radius"), 1.0);
    EXPECT_EQ(root.at("outlets").at(std::size_t{2}).at("region").text("shape"), "sphere");
}

TEST(ScenarioReader, OverridesAreAppliedInOrder) {
    const std::string walls =
        "walls: [{shape: plane, name: a, material: glass, point: [0, 0, 0], normal: [0, 0, 1]}]\n";
    const Node root = read_good(kBase + walls, {"time.step=2 ms", "time.step=3 ms", "walls[0].point[2]=-1 cm",
                                                "materials.steel.density=7800", "outlets[+].name=out",
                                                "outlets[0].region={shape: sphere, centre: [0, 0, 0], radius: 1}",
                                                "title=\"a=b\"", "solver.method=gauss_seidel"})
                          .root;
    EXPECT_EQ(root.at("time").number("step"), 0.003);
    EXPECT_EQ(root.at("walls").at(std::size_t{0}).vector("point"), Vec3(0.0, 0.0, -0.01));
    EXPECT_EQ(root.at("materials").at("steel").number("density"), 7800.0);
    EXPECT_EQ(root.at("outlets").at(std::size_t{0}).text("name"), "out");
    EXPECT_EQ(root.text("title"), "a=b");
    EXPECT_EQ(root.at("time").at("step").mark.file, "--set time.step=3 ms");
}

TEST(ScenarioReader, TheResolvedTextReadsBackToTheSameTree) {
    const std::string text =
        kBase +
        "title: \"quote \\\" slash \\\\ line\\nend \\u00e9 \\t # : [\"\n"
        "seed: 9007199254740993\norigin: [538500.123456789, 5576504.1, -0.0]\ngravity_table: [[0, 0, 0, -9.81], [1, "
        "1e-300, 0.1, 0.3]]\n"
        "pairs: [{materials: [glass, glass], friction: 0.1}]\n"
        "bodies:\n"
        "- {generator: random, material: glass, size: {distribution: table, rows: [[1 mm, 0], [3 mm, 1]]}, count: 5,\n"
        "   region: {shape: cylinder, base: [0.1, 0.2, 0.3], radius: 1, length: 0.7}}\n"
        "- {generator: file, path: grains.txt, columns: [x, y, z, d, material], scale: 0.001}\n"
        "- {generator: sphere, material: glass, position: [0, 0, 0], radius: 0.1, spin: [1 rpm, 0, 0]}\n"
        "walls:\n"
        "- {shape: cylinder, name: drum, material: glass, base: [0, 0, 0], radius: 1, motion: {rate: 7 rpm, phase: 33 "
        "deg}}\n"
        "inlets: [{name: i, material: glass, mass_rate: 3 t/h, size: {distribution: log_normal, median: 1 mm, sigma: "
        "0.3},\n"
        "          region: {shape: box, lower: [0, 0, 0], upper: [1, 1, 1]}}]\n"
        "measures: [{measure: profile, name: p, lower: 0, upper: 1, bins: 7}]\n";
    const ReadResult first = read_good(text), second = read_good(first.resolved);
    EXPECT_TRUE(same(first.root, second.root));
    EXPECT_EQ(first.resolved, second.resolved);
    EXPECT_EQ(first.text, text);
    EXPECT_FALSE(first.root.has("gravity"));  // gravity_table stands in its place
    EXPECT_EQ(second.root.integer("seed"), 9007199254740993);
    EXPECT_EQ(second.root.text("title"), "quote \" slash \\ line\nend \u00e9 \t # : [");
    EXPECT_TRUE(std::signbit(second.root.vector("origin").z()));
}

TEST_F(Includes, TheIncludingFileWins) {
    write("parts/base.yaml",
          "scenario_version: 1\ninclude: deep.yaml\ntime: {end: 1, step: 1}\nseed: 2\ntitle: base\n");
    write("parts/deep.yaml", "materials: {glass: {density: 1, friction: 0.1}}\nseed: 3\ndescription: deep\n");
    write("parts/other.yaml", "title: other\noutput: {fields: [spin, mass]}\n");
    const std::string main = write("main.yaml",
                                   "include: [parts/base.yaml, parts/other.yaml]\ntime: {step: 0.5}\n"
                                   "materials: {glass: {density: 7}}\noutput: {fields: [spin]}\n");
    Diagnostics diagnostics;
    const ReadResult result = read_scenario(main, {}, diagnostics);
    ASSERT_EQ(diagnostics.report(), "");
    EXPECT_EQ(result.root.at("time").number("step"), 0.5);
    EXPECT_EQ(result.root.at("time").number("end"), 1.0);
    EXPECT_EQ(result.root.at("materials").at("glass").number("density"), 7.0);
    EXPECT_EQ(result.root.at("materials").at("glass").number("friction"), 0.1);
    EXPECT_EQ(result.root.integer("seed"), 2);
    EXPECT_EQ(result.root.text("title"), "other");
    EXPECT_EQ(result.root.text("description"), "deep");
    EXPECT_EQ(result.root.at("output").at("fields").size(), 1U);
    EXPECT_EQ(result.files, (std::vector<std::string>{main, path("parts/base.yaml"), path("parts/deep.yaml"),
                                                      path("parts/other.yaml")}));
}

TEST_F(Includes, NamesOfFilesAreMeantFromTheFileThatNamesThem) {
    write("parts/grains.yaml", "bodies: [{generator: file, path: grains.txt, material: glass}]\n");
    const std::string main = write("main.yaml", "include: parts/grains.yaml\n" + kBase);
    Diagnostics diagnostics;
    const ReadResult first = read_scenario(main, {}, diagnostics);
    const ReadResult again = read_scenario_text(first.resolved, main, {}, diagnostics);
    ASSERT_EQ(diagnostics.report(), "");
    EXPECT_EQ(first.root.at("bodies").at(std::size_t{0}).text("path"), "parts/grains.txt");
    EXPECT_TRUE(same(first.root, again.root));
}

TEST_F(Includes, FaultsNameTheIncludedFile) {
    const std::string part = write("parts/base.yaml", "time:\n  end: soon\n");
    const std::string main =
        write("main.yaml", "include: parts/base.yaml\nscenario_version: 1\ntime: {step: 1}\nmaterials: {}\nsead: 3\n");
    Diagnostics diagnostics;
    read_scenario(main, {}, diagnostics);
    const std::string report = diagnostics.report();
    EXPECT_NE(report.find(main + ":5:1: error: 'sead' is not a key of the scenario (did you mean 'seed'?)"),
              std::string::npos)
        << report;
    EXPECT_NE(
        report.find(part + ":2:8: error: time.end: 'soon' is not a number; expected a time > 0 (s, ms, us, min, h)\n"
                           "      end: soon\n"
                           "           ^\n"),
        std::string::npos)
        << report;
}

TEST_F(Includes, ACircleIsShown) {
    const std::string a = write("a.yaml", "include: b.yaml\n"),
                      b = write("b.yaml", "seed: 1\ninclude: parts/../a.yaml\n");
    Diagnostics diagnostics;
    read_scenario(a, {}, diagnostics);
    EXPECT_EQ(diagnostics.report(), b + ":2:10: error: files include each other: " + a + " -> " + b + " -> " + a +
                                        "\n    include: parts/../a.yaml\n             ^\n");
}

TEST_F(Includes, AMissingFileIsNamedWhereItIsAskedFor) {
    const std::string main = write("main.yaml", "include: [no.yaml, parts, 3: 4]\n");
    Diagnostics diagnostics;
    read_scenario(main, {}, diagnostics);
    const std::string report = diagnostics.report();
    EXPECT_NE(report.find(main + ":1:11: error: '" + path("no.yaml") + "': there is no such file\n"),
              std::string::npos);
    EXPECT_NE(report.find(main + ":1:20: error: '" + path("parts") + "': this is a folder, not a file\n"),
              std::string::npos);
    EXPECT_NE(report.find(main + ":1:27: error: include: expected the name of a file, or a list of names\n"),
              std::string::npos)
        << report;
}

TEST_F(Includes, AMissingScenario) {
    Diagnostics diagnostics, folder;
    read_scenario(path("no.yaml"), {}, diagnostics);
    EXPECT_EQ(diagnostics.report(), path("no.yaml") + ": error: there is no such file\n");
    read_scenario(path("parts"), {}, folder);
    EXPECT_EQ(folder.report(), path("parts") + ": error: this is a folder, not a file\n");
}

}  // namespace
}  // namespace scree::io
