// A scenario file with all that it includes, merged into one tree.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/scenario/yaml_tree.hpp"

namespace scree::io {

struct Included {
    YamlValue tree;                  // without the key `include`
    std::vector<std::string> files;  // every file that was read, the main file first
    std::string text;                // of the main file
};
// Reads `path` and, depth first, what it includes. The including file wins over the included ones, later ones over
// earlier ones. Nothing if a file cannot be used; faults are in `diagnostics`.
std::optional<Included> read_with_includes(const std::string& path, Diagnostics& diagnostics);
// The same for a text at hand; `name` stands for its file: its folder is where relative includes start.
std::optional<Included> read_text_with_includes(const std::string& text, const std::string& name,
                                                Diagnostics& diagnostics);

}  // namespace scree::io
