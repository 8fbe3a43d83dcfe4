// The schema table as JSON Schema (draft-07), for completion and marks of faults in editors (yaml-language-server).
#pragma once

#include <string>

namespace scree::io {

std::string schema_json();

}  // namespace scree::io
