// The JSON Schema against python3-jsonschema: what the reader takes it takes, what is wrong in form it refuses.
#include "io/scenario/schema_json.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/scenario/scenario_reader.hpp"

namespace scree::io {
namespace {

namespace fs = std::filesystem;

// Numbers as YAML 1.2 (and editors) see them: 1e-3 is one. Exit 0: valid, 1: not valid, 3: no modules.
const char* const kChecker = R"(
import sys, json, re
try:
    import yaml, jsonschema
except ImportError:
    sys.exit(3)
class Loader(yaml.SafeLoader):
    pass
Loader.add_implicit_resolver('tag:yaml.org,2002:float', re.compile(r'^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$'), list('-+.0123456789'))
schema = json.load(open(sys.argv[1]))
jsonschema.Draft7Validator.check_schema(schema)
faults = [e.message for e in jsonschema.Draft7Validator(schema).iter_errors(yaml.load(open(sys.argv[2]), Loader))]
print('\n'.join(faults))
sys.exit(1 if faults else 0)
)";

class JsonSchema : public testing::Test {
  protected:
    JsonSchema() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() / (std::string("scree_json_") + info->name());
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        std::ofstream(folder_ / "check.py") << kChecker;
        std::ofstream(folder_ / "schema.json") << schema_json();
    }
    ~JsonSchema() override { fs::remove_all(folder_); }
    // The exit code of the check.
    int check(const std::string& text) {
        std::ofstream(folder_ / "s.yaml") << text;
        const std::string python = fs::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
        const std::string in = folder_.string();
        const int status = std::system(
            (python + " " + in + "/check.py " + in + "/schema.json " + in + "/s.yaml > " + in + "/out.txt 2>&1")
                .c_str());
        return status / 256;
    }
    std::string output() const {
        std::ifstream stream(folder_ / "out.txt");
        return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    }
    fs::path folder_;
};

const std::string kBase =
    "scenario_version: 1\n"
    "time: {end: 1, step: 1e-3}\n"
    "materials: {glass: {density: 2.5 g/cm3}}\n";

TEST_F(JsonSchema, IsDraft7WithDescriptions) {
    const auto schema = nlohmann::json::parse(schema_json());
    EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    EXPECT_FALSE(schema["additionalProperties"].get<bool>());
    EXPECT_NE(schema["properties"]["time"]["properties"]["step"]["description"], "");
    EXPECT_EQ(schema["properties"]["gravity"]["default"], nlohmann::json::parse("[0, 0, -9.81]"));
}

TEST_F(JsonSchema, TakesGoodScenarios) {
    const std::vector<std::string> good{
        kBase, "include: base.yaml\ntime: {step: 2 ms}\nmaterials: {glass: {friction: 0.1}}\n",
        kBase +
            "gravity: [0, 0, -1.62 m/s2]\nsolver: {method: gauss_seidel, warm_start: false, block_size: 0.1}\n"
            "pairs: [{materials: [glass, glass], friction: 0}]\n"
            "bodies:\n"
            "- {generator: random, name: bed, material: glass, size: {distribution: uniform, lower: 1 mm, upper: 2 "
            "mm},\n"
            "   region: {shape: cylinder, base: [0, 0, 0], radius: 1, length: 1 m}, mass: 3 kg}\n"
            "- {generator: sphere, material: glass, position: [0, 0, 0], radius: 1}\n"
            "- {generator: lattice, material: glass, size: {distribution: fixed, diameter: 1}, corner: [0, 0, 0],\n"
            "   pitch: [1, 2, 3 cm], cells: [1, 1, 1], clip: {shape: sphere, centre: [0, 0, 0], radius: 1}}\n"
            "- {generator: file, path: a.txt, columns: [x, y, z, d, material]}\n"
            "walls:\n"
            "- {shape: plane, name: floor, material: glass, point: [0, 0, 0], normal: [0, 0, 1], motion: {rate: 3 "
            "rpm}}\n"
            "measures: [{measure: wall_force, name: f, wall: floor, from: 1 s}]\n"
            "output: {fields: [velocity, spin], compression: 9}\n"};
    for (const std::string& text : good) {
        const int code = check(text);
        if (code == 3) GTEST_SKIP() << "python3-jsonschema and python3-yaml are not installed";
        EXPECT_EQ(code, 0) << text << output();
    }
    // The resolved text is a scenario too.
    Diagnostics diagnostics;
    const ReadResult read = read_scenario_text(good[2], "s.yaml", {}, diagnostics);
    ASSERT_EQ(diagnostics.report(), "");
    EXPECT_EQ(check(read.resolved), 0) << output();
}

TEST_F(JsonSchema, RefusesWhatTheReaderRefuses) {
    const std::vector<std::string> bad{
        "scenario_version: 1\n",
        "scenario_version: 2\ntime: {end: 1, step: 1}\nmaterials: {}\n",
        "scenario_version: 1\ntime: {end: 1}\nmaterials: {}\n",
        "scenario_version: 1\ntime: {end: 1, step: 1}\nmaterials: {a: {friction: 1}}\n",
        kBase + "tme: 1\n",
        kBase + "solver: {method: jacobi}\n",
        kBase + "solver: {tolerance: 0}\n",
        kBase + "solver: {tolerance: \"0.1\"}\n",
        kBase + "solver: {block_size: 3 kg}\n",
        kBase + "solver: {max_sweeps: 1.5}\n",
        kBase + "correction: {share: 2}\n",
        kBase + "output: {contacts: 1}\n",
        kBase + "output: {fields: [colour]}\n",
        kBase + "gravity: [0, 0]\n",
        kBase + "gravity: [0, 0, 0]\ngravity_table: [[0, 0, 0, 0]]\n",
        kBase + "gravity_table: [[0, 0, 0]]\n",
        kBase + "walls: [{shape: plane, name: a, material: glass, point: [0, 0, 0]}]\n",
        kBase + "walls: [{shape: plane, name: a, material: glass, point: [0, 0, 0], normal: [0, 0, 1], radius: 1}]\n",
        kBase + "walls: [{shape: plain}]\n",
        kBase + "walls: [{name: a}]\n",
        kBase + "bodies: [{generator: sphere, material: glass, position: [0, 0, 0]}]\n",
        kBase + "bodies: [{generator: sphere, material: glass, position: [0, 0, 0], radius: 1, diameter: 2}]\n",
        kBase + "outlets: [{name: a b, region: {shape: sphere, centre: [0, 0, 0], radius: 1}}]\n",
        kBase +
            "inlets: [{name: a, material: glass, mass_rate: 1, size: {distribution: fixed, diameter: 1}, region: "
            "{shape: sphere, centre: [0, 0, 0], radius: 1}}]\n",
        kBase + "title: 3\n"};
    for (const std::string& text : bad) {
        const int code = check(text);
        if (code == 3) GTEST_SKIP() << "python3-jsonschema and python3-yaml are not installed";
        EXPECT_EQ(code, 1) << text << output();
        Diagnostics diagnostics;
        read_scenario_text(text, "s.yaml", {}, diagnostics);
        EXPECT_TRUE(diagnostics.has_errors()) << text;
    }
}

}  // namespace
}  // namespace scree::io
