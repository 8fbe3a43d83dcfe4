// The schema table in words: what a key expects, `scree explain`, and the reference page.
#pragma once

#include <string>
#include <string_view>

#include "io/scenario/schema.hpp"

namespace scree::io {

// "a length > 0 (m, cm, mm, um, km)": what a key takes, as it stands in messages.
std::string expectation(const SchemaNode& node);
// The same of one item of a list of sections, or of one section that the user names.
std::string section_expectation(const SchemaNode& node);
// The same of one number.
std::string number_expectation(Dimension dimension, const Range& range);

// What a key means: kind, unit, default, range, consequence. `key`: time.step, walls[plane].normal, walls.plane.normal,
// walls[3].normal, a section (all its keys), or a last part alone (all keys of that name). Throws Error (usage) with
// the nearest names if there is none.
std::string explain(std::string_view key);

// All keys, in Markdown.
std::string reference_markdown();

}  // namespace scree::io
