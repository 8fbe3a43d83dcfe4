// What keys must satisfy together: groups of which one may be given, order, names that exist and are unique.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "io/scenario/node_reader.hpp"

namespace scree::io {

void NodeReader::check_rules(const Section& section, const YamlValue& yaml, const Node::Map& map) {
    for (const Rule* rule : section.rules()) {
        if (rule->kind == Rule::Kind::ascending) {
            check_order(section, *rule, yaml, map);
        } else {
            check_group(section, *rule, yaml);
        }
    }
}

void NodeReader::check_group(const Section& section, const Rule& rule, const YamlValue& yaml) {
    std::vector<const YamlEntry*> given;
    for (const std::string& key : rule.keys) {
        if (const YamlEntry* entry = yaml.find(key)) given.push_back(entry);
    }
    if (given.empty() && rule.kind != Rule::Kind::at_most_one) {
        diagnostics_.error(section.mark,
                           fmt::format("{} lacks one of the keys {}", section.described(), fmt::join(rule.keys, ", ")));
    }
    if (rule.kind == Rule::Kind::at_least_one) return;
    for (std::size_t i = 1; i < given.size(); ++i) {
        diagnostics_.error(given[i]->mark, fmt::format("'{}' and '{}' of {} exclude each other; keep one",
                                                       given[0]->key, given[i]->key, section.described()));
    }
}

// Whole numbers may be equal, quantities must rise.
void NodeReader::check_order(const Section& section, const Rule& rule, const YamlValue& yaml, const Node::Map& map) {
    const auto low = map.find(rule.keys[0]), high = map.find(rule.keys[1]);
    if (low == map.end() || high == map.end()) return;
    const bool whole = std::holds_alternative<std::int64_t>(low->second.value);
    const auto refuse = [&](const std::string& component, double a, double b) {
        const bool at_high = yaml.find(rule.keys[1]) != nullptr;  // else the default is the upper one
        const auto path = [&](std::size_t i) { return section.path_of(rule.keys[i]) + component; };
        diagnostics_.error((at_high ? high : low)->second.mark, fmt::format("{} is {}, which is {} {}, {}", path(1), b,
                                                                            whole ? "below" : "not above", path(0), a));
    };
    if (const auto* lower = std::get_if<Vec3>(&low->second.value)) {
        const Vec3 upper = high->second.vector();
        for (int i = 0; i < 3; ++i) {
            if (!((*lower)[i] < upper[i])) refuse(fmt::format("[{}]", i), (*lower)[i], upper[i]);
        }
        return;
    }
    const double a = low->second.number(), b = high->second.number();
    if (!(a < b || (whole && a == b))) refuse("", a, b);
}

void NodeReader::note_name(const SchemaNode& schema, const Node& node) {
    const Row& row = *schema.row;
    if (row.is_unique) {
        auto& names = names_[row.path.substr(0, row.path.find("[]"))];
        const auto same =
            std::find_if(names.begin(), names.end(), [&](const Name& n) { return n.text == node.text(); });
        if (same != names.end()) {
            diagnostics_.error(node.mark, fmt::format("{}: '{}' is taken already, by {} on line {}", node.path,
                                                      node.text(), same->path, same->mark.line));
        }
        names.push_back({node.text(), node.path, node.mark});
    }
    if (row.refers_to.empty()) return;
    if (row.kind == Kind::text) {
        references_.emplace_back(row.refers_to, Name{node.text(), node.path, node.mark});
    } else {
        for (const Node& item : node.items()) {
            references_.emplace_back(row.refers_to, Name{item.text(), item.path, item.mark});
        }
    }
}

void NodeReader::check_references() {
    for (const auto& [where, reference] : references_) {
        std::vector<std::string> known;
        for (const Name& name : names_[where]) known.push_back(name.text);
        if (std::find(known.begin(), known.end(), reference.text) != known.end()) continue;
        const std::string list = known.empty() ? "none is given" : fmt::format("there are {}", fmt::join(known, ", "));
        diagnostics_.error(reference.mark,
                           fmt::format("{}: '{}' is not one of the {}{}; {}", reference.path, reference.text, where,
                                       did_you_mean(reference.text, known), list));
    }
}

}  // namespace scree::io
