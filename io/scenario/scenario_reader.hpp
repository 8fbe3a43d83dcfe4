// Reads a scenario: YAML with includes and overrides, checked against the schema table, every default filled in.
#pragma once

#include <string>
#include <vector>

#include "io/scenario/diagnostics.hpp"
#include "io/scenario/scenario_node.hpp"

namespace scree::io {

struct ReadResult {
    Node root;             // whole only if `diagnostics` has no errors
    std::string text;      // of the main file
    std::string resolved;  // YAML of the whole tree, in SI: reads back to the same values; "" if there are errors
    std::vector<std::string> files;
};

// Every fault of the scenario goes to `diagnostics`. Relative names of files are relative to the folder of `path`, also
// in the result.
ReadResult read_scenario(const std::string& path, const std::vector<std::string>& overrides, Diagnostics& diagnostics);
// `name` stands for the path in messages, and its folder for the scenario's.
ReadResult read_scenario_text(const std::string& text, const std::string& name,
                              const std::vector<std::string>& overrides, Diagnostics& diagnostics);

// The tree as YAML, in the order of the schema; doubles by their shortest form that reads back to the same bits.
std::string resolved_text(const Node& root);

}  // namespace scree::io
