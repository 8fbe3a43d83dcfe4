// Which keys differ between two scenarios, and which of them a run may change when it goes on.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/scenario/scenario_node.hpp"

namespace scree::app {

// Paths of values that differ or that only one of them has.
std::vector<std::string> differing_keys(const io::Node& a, const io::Node& b);

// time.end, output and texts: they change no step.
bool may_change_on_resume(std::string_view path);

}  // namespace scree::app
