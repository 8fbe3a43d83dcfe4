// A YAML text as a tree with the place of every key and value, before anything is known about its meaning.
//
// yaml-cpp's own nodes silently keep duplicate keys and do not tell "0.5" from 0.5; this tree, made from its events,
// refuses the first and keeps the second. Anchors, aliases and the merge key `<<` are resolved here.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/scenario/diagnostics.hpp"

namespace scree::io {

struct YamlEntry;

struct YamlValue {
    enum class Kind { null, scalar, list, map };

    Kind kind = Kind::null;
    std::string text;     // of a scalar
    bool quoted = false;  // a scalar in quotes (or a block text): never a number
    std::vector<YamlValue> items;
    std::vector<YamlEntry> entries;  // in the order of the file, each key once
    Mark mark;

    YamlEntry* find(std::string_view key);
    const YamlEntry* find(std::string_view key) const;
};

struct YamlEntry {
    std::string key;
    Mark mark;  // of the key
    YamlValue value;
};

// One document. Faults (syntax, duplicate keys) go to `diagnostics` under the name `file`; none if nothing can be used.
std::optional<YamlValue> parse_yaml(const std::string& text, const std::string& file, Diagnostics& diagnostics);

// Maps are merged key by key, anything else in `over` replaces what is in `base`.
void merge_over(YamlValue& base, YamlValue over);

}  // namespace scree::io
