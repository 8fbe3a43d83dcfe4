// Changes of a scenario from the command line: `time.step=5e-4`, `walls[0].radius=2 cm`, `outlets[+]={name: a, ...}`.
#pragma once

#include <string>

#include "io/scenario/yaml_tree.hpp"

namespace scree::io {

// The name under which faults in an override are reported.
std::string override_name(const std::string& text);

// Sets one value of `tree`. The path is made of names and of [i], which counts from 0; [+] appends. The value is YAML.
// Maps that are not there are made. Faults go to `diagnostics`, with their place in the text of the override.
void apply_override(const std::string& text, YamlValue& tree, Diagnostics& diagnostics);

}  // namespace scree::io
