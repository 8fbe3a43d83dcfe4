// Scenarios from text, for tests: what is built, and what is said when it cannot be.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "io/scenario/scenario_reader.hpp"
#include "scenarios/build.hpp"

namespace scree::testing {

inline const std::string kHead =
    "scenario_version: 1\n"
    "time: {end: 1, step: 1e-3}\n"
    "materials:\n"
    "  glass: {density: 2500, friction: 0.5, restitution: 0.2}\n"
    "  steel: {density: 7800, friction: 0.3, restitution: 0.6}\n";

struct Result {
    scenarios::Built built;
    std::string errors, warnings;
};

// Of two builds: the same bodies and shapes, to the bit.
inline void expect_same_bodies(const State& a, const State& b) {
    EXPECT_EQ(a.bodies.id, b.bodies.id);
    EXPECT_EQ(a.bodies.radius, b.bodies.radius);
    EXPECT_EQ(a.bodies.mass, b.bodies.mass);
    EXPECT_EQ(a.bodies.position, b.bodies.position);
    EXPECT_EQ(a.bodies.shape, b.bodies.shape);
    ASSERT_EQ(a.bodies.orientation.size(), b.bodies.orientation.size());
    for (std::size_t i = 0; i < a.bodies.orientation.size(); ++i)
        EXPECT_EQ(a.bodies.orientation[i].coeffs(), b.bodies.orientation[i].coeffs());
    ASSERT_EQ(a.shapes.size(), b.shapes.size());
    for (std::size_t i = 0; i < a.shapes.size(); ++i) EXPECT_EQ(a.shapes[i].vertex, b.shapes[i].vertex);
}

// Reads and builds; `folder` is where files of bodies are looked for.
inline Result build_text(const std::string& text, const std::string& folder = ".") {
    io::Diagnostics diagnostics;
    const std::string name = (std::filesystem::path(folder) / "test.yaml").string();
    const io::ReadResult read = io::read_scenario_text(text, name, {}, diagnostics);
    Result result;
    if (!diagnostics.has_errors()) result.built = scenarios::build(read.root, folder, diagnostics);
    result.errors = diagnostics.report();
    result.warnings = diagnostics.warnings();
    if (result.errors.empty()) {  // what the other ranks build
        io::Diagnostics others;
        const io::ReadResult resolved = io::read_scenario_text(read.resolved, name, {}, others);
        EXPECT_EQ(others.report(), "");
        if (!others.has_errors())
            expect_same_bodies(result.built.state, scenarios::build(resolved.root, folder, others).state);
        EXPECT_EQ(others.report(), "");
    }
    return result;
}

inline scenarios::Built build_good(const std::string& text, const std::string& folder = ".") {
    Result result = build_text(text, folder);
    EXPECT_EQ(result.errors, "");
    return result.built;
}

// The text is refused, with every one of these parts in the report.
inline void expect_error(const std::string& text, const std::vector<std::string>& parts,
                         const std::string& folder = ".") {
    const Result result = build_text(text, folder);
    for (const std::string& part : parts) {
        EXPECT_NE(result.errors.find(part), std::string::npos)
            << "missing: " << part << "\nin: " << (result.errors.empty() ? "(no error)" : result.errors);
    }
}

// A folder that is gone after the test.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "scree_test_XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path_ = pattern;
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::string& path() const { return path_; }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(std::filesystem::path(path_) / name) << text;
    }

  private:
    std::string path_;
};

}  // namespace scree::testing
