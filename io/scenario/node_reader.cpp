#include "io/scenario/node_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/errors.hpp"
#include "io/scenario/schema_text.hpp"

namespace scree::io {
namespace {

namespace fs = std::filesystem;
using YamlKind = YamlValue::Kind;

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
    const std::string nearest = nearest_name(word, names);
    return nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest);
}

std::string NodeReader::Section::described() const {
    if (path.empty()) return "the scenario";
    return form == nullptr ? path : fmt::format("{} ({}: {})", path, schema.variant_key, form->key);
}
std::string NodeReader::Section::path_of(std::string_view key) const {
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}
std::vector<const SchemaNode*> NodeReader::Section::keys() const {
    std::vector<const SchemaNode*> all = schema.keys;
    if (form != nullptr) all.insert(all.end(), form->keys.begin(), form->keys.end());
    return all;
}
std::vector<const Rule*> NodeReader::Section::rules() const {
    std::vector<const Rule*> all = schema.rules;
    if (form != nullptr) all.insert(all.end(), form->rules.begin(), form->rules.end());
    return all;
}
const SchemaNode* NodeReader::Section::find(std::string_view key) const {
    const SchemaNode* found = schema.find_key(key);
    return found == nullptr && form != nullptr ? form->find_key(key) : found;
}

NodeReader::NodeReader(const std::string& main_file, Diagnostics& diagnostics)
    : main_file_(main_file), diagnostics_(diagnostics), values_(diagnostics) {}

Node NodeReader::read_scenario(const YamlValue& yaml) {
    auto root = read_section(schema_root(), yaml, "", {main_file_, 1, 1});
    check_references();
    return root ? std::move(*root) : Node{};
}

std::optional<Node> NodeReader::read(const SchemaNode& schema, const YamlValue& yaml, const std::string& path,
                                     const Mark& mark) {
    switch (schema.row->kind) {
        case Kind::section:
            return read_section(schema, yaml, path, mark);
        case Kind::list:
            return read_list(schema, yaml, path);
        case Kind::named:
            return read_named(schema, yaml, path);
        default:
            return read_value(schema, yaml, path);
    }
}

std::optional<Node> NodeReader::read_section(const SchemaNode& schema, const YamlValue& yaml, const std::string& path,
                                             const Mark& mark) {
    if (yaml.kind != YamlKind::map) {
        values_.refuse(yaml.mark, path, describe(yaml), section_expectation(schema));
        return std::nullopt;
    }
    Node node{Node::Map{}, yaml.mark, path, given_};
    Node::Map& map = std::get<Node::Map>(node.value);
    const SchemaNode* form = nullptr;
    if (!schema.variants.empty()) {
        form = pick_form(schema, yaml, path, mark, map);
        if (form == nullptr) return std::nullopt;  // which keys are right depends on the form
    }
    const Section section{schema, form, path, mark};
    const std::size_t errors = diagnostics_.error_count();
    read_given(section, yaml, map);
    fill_in(section, yaml, map);
    check_rules(section, yaml, map);
    if (diagnostics_.error_count() != errors) return std::nullopt;
    return node;
}

const SchemaNode* NodeReader::pick_form(const SchemaNode& schema, const YamlValue& yaml, const std::string& path,
                                        const Mark& mark, Node::Map& map) {
    const std::string expected = fmt::format("one of {}", fmt::join(schema.variant_names(), ", "));
    const YamlEntry* entry = yaml.find(schema.variant_key);
    if (entry == nullptr) {
        values_.refuse(mark, path, fmt::format("'{}' is missing", schema.variant_key), expected);
        return nullptr;
    }
    const SchemaNode* form = schema.find_variant(entry->value.text);
    const std::string key_path = path + "." + schema.variant_key;
    if (entry->value.kind != YamlKind::scalar || form == nullptr) {
        const std::string hint = did_you_mean(entry->value.text, schema.variant_names());
        values_.refuse(entry->value.mark, key_path, describe(entry->value) + hint, expected);
        return nullptr;
    }
    map.emplace(schema.variant_key, Node{form->key, entry->value.mark, key_path, given_});
    return form;
}

void NodeReader::read_given(const Section& section, const YamlValue& yaml, Node::Map& map) {
    for (const YamlEntry& entry : yaml.entries) {
        if (section.form != nullptr && entry.key == section.schema.variant_key) continue;
        const SchemaNode* key = section.find(entry.key);
        if (key == nullptr) {
            unknown_key(section, entry);
        } else if (auto node = read(*key, entry.value, section.path_of(entry.key), entry.mark)) {
            map.emplace(entry.key, std::move(*node));
        }
    }
}

void NodeReader::unknown_key(const Section& section, const YamlEntry& entry) {
    std::vector<std::string> names;
    if (section.form != nullptr) names.push_back(section.schema.variant_key);
    for (const SchemaNode* key : section.keys()) names.push_back(key->key);
    diagnostics_.error(entry.mark,
                       fmt::format("'{}' is not a key of {}{}; its keys are {}", entry.key, section.described(),
                                   did_you_mean(entry.key, names), fmt::join(names, ", ")));
}

// Defaults stand in the table as YAML.
const YamlValue& NodeReader::default_of(const Row& row) {
    const auto known = defaults_.find(&row);
    if (known != defaults_.end()) return known->second;
    Diagnostics faults;
    auto yaml = parse_yaml(row.standard, row.path, faults);
    if (!yaml || faults.has_errors()) throw InternalError("the default of " + row.path + ": " + faults.report());
    return defaults_.emplace(&row, std::move(*yaml)).first->second;
}

void NodeReader::fill_in(const Section& section, const YamlValue& yaml, Node::Map& map) {
    const auto replaced = [&](const SchemaNode& key) {  // another key of its group is given in its place
        for (const Rule* rule : section.rules()) {
            if (rule->kind == Rule::Kind::ascending || rule->kind == Rule::Kind::at_least_one) continue;
            const auto& keys = rule->keys;
            if (std::find(keys.begin(), keys.end(), key.key) == keys.end()) continue;
            if (std::any_of(keys.begin(), keys.end(), [&](const auto& k) { return yaml.find(k) != nullptr; }))
                return true;
        }
        return false;
    };
    for (const SchemaNode* key : section.keys()) {
        if (yaml.find(key->key) != nullptr || replaced(*key)) continue;
        if (key->row->is_required) {
            diagnostics_.error(section.mark, fmt::format("{} lacks the key '{}': expected {}", section.described(),
                                                         key->key, expectation(*key)));
        } else if (!key->row->standard.empty()) {
            const bool outer = std::exchange(given_, false);
            const YamlValue& standard = default_of(*key->row);
            auto node = read(*key, standard, section.path_of(key->key), section.mark);
            given_ = outer;
            if (node) map.emplace(key->key, std::move(*node));
        }
    }
}

std::optional<Node> NodeReader::read_list(const SchemaNode& schema, const YamlValue& yaml, const std::string& path) {
    if (yaml.kind != YamlKind::list) {
        values_.refuse(yaml.mark, path, describe(yaml), expectation(schema));
        return std::nullopt;
    }
    Node node{Node::List{}, yaml.mark, path, given_};
    Node::List& list = std::get<Node::List>(node.value);
    for (std::size_t i = 0; i < yaml.items.size(); ++i) {
        const YamlValue& item = yaml.items[i];
        auto element = read_section(schema, item, fmt::format("{}[{}]", path, i), item.mark);
        if (element) list.push_back(std::move(*element));
    }
    return node;
}

std::optional<Node> NodeReader::read_named(const SchemaNode& schema, const YamlValue& yaml, const std::string& path) {
    if (yaml.kind != YamlKind::map) {
        values_.refuse(yaml.mark, path, describe(yaml), expectation(schema));
        return std::nullopt;
    }
    Node node{Node::Map{}, yaml.mark, path, given_};
    for (const YamlEntry& entry : yaml.entries) {
        const std::string item_path = fmt::format("{}.{}", path, entry.key);
        names_[schema.row->path].push_back({entry.key, item_path, entry.mark});
        if (!values_.check_name(entry.key, entry.mark, path)) continue;
        auto section = read_section(schema, entry.value, item_path, entry.mark);
        if (section) std::get<Node::Map>(node.value).emplace(entry.key, std::move(*section));
    }
    return node;
}

std::optional<Node> NodeReader::read_value(const SchemaNode& schema, const YamlValue& yaml, const std::string& path) {
    Node node;
    node.mark = given_ ? yaml.mark : Mark{main_file_, 0, 0};
    node.path = path;
    node.given = given_;
    if (!values_.read(schema, yaml, path, node)) return std::nullopt;
    note_name(schema, node);
    if (schema.row->is_file) node.value = from_main_folder(node);
    return node;
}

// A name of a file in an included file is meant from that file's folder.
std::string NodeReader::from_main_folder(const Node& node) const {
    const fs::path main_folder = fs::path(main_file_).parent_path();
    const bool in_file = node.mark.file.rfind("--set ", 0) != 0;
    const fs::path folder = in_file ? fs::path(node.mark.file).parent_path() : main_folder;
    if (fs::path(node.text()).is_absolute() || folder == main_folder) return node.text();
    const fs::path file = (folder / node.text()).lexically_normal();
    std::error_code error;
    const fs::path relative =
        fs::absolute(file, error)
            .lexically_normal()
            .lexically_relative(fs::absolute(main_folder.empty() ? "." : main_folder, error).lexically_normal());
    return relative.empty() ? file.string() : relative.string();
}

}  // namespace scree::io
