// A whole scenario tree: sections, lists and forms, unknown and missing keys, defaults, and what keys must satisfy
// together.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/scenario/value_reader.hpp"

namespace scree::io {

// " (did you mean 'x'?)", or nothing if no name is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

class NodeReader {
  public:
    // `main_file`: its folder is what relative names of files are made relative to.
    NodeReader(const std::string& main_file, Diagnostics& diagnostics);

    Node read_scenario(const YamlValue& yaml);

  private:
    struct Name {
        std::string text, path;
        Mark mark;
    };
    // Where the reader is: the section's path, its form, and the place to which missing keys are reported.
    struct Section {
        const SchemaNode& schema;
        const SchemaNode* form;
        std::string path;
        Mark mark;
        std::string described() const;  // "walls[2] (shape: plane)", "the scenario"
        std::string path_of(std::string_view key) const;
        std::vector<const SchemaNode*> keys() const;
        std::vector<const Rule*> rules() const;
        const SchemaNode* find(std::string_view key) const;
    };

    std::optional<Node> read(const SchemaNode& schema, const YamlValue& yaml, const std::string& path,
                             const Mark& mark);
    std::optional<Node> read_section(const SchemaNode& schema, const YamlValue& yaml, const std::string& path,
                                     const Mark& mark);
    std::optional<Node> read_list(const SchemaNode& schema, const YamlValue& yaml, const std::string& path);
    std::optional<Node> read_named(const SchemaNode& schema, const YamlValue& yaml, const std::string& path);
    std::optional<Node> read_value(const SchemaNode& schema, const YamlValue& yaml, const std::string& path);

    // The form that the section's variant key picks; nothing if that is missing or unknown.
    const SchemaNode* pick_form(const SchemaNode& schema, const YamlValue& yaml, const std::string& path,
                                const Mark& mark, Node::Map& map);
    void read_given(const Section& section, const YamlValue& yaml, Node::Map& map);
    const YamlValue& default_of(const Row& row);
    void fill_in(const Section& section, const YamlValue& yaml, Node::Map& map);
    void check_rules(const Section& section, const YamlValue& yaml, const Node::Map& map);
    void check_group(const Section& section, const Rule& rule, const YamlValue& yaml);
    void check_order(const Section& section, const Rule& rule, const YamlValue& yaml, const Node::Map& map);
    void unknown_key(const Section& section, const YamlEntry& entry);
    void note_name(const SchemaNode& schema, const Node& node);
    void check_references();
    std::string from_main_folder(const Node& node) const;

    std::string main_file_;
    Diagnostics& diagnostics_;
    ValueReader values_;
    std::map<const Row*, YamlValue> defaults_;        // parsed once
    bool given_ = true;                               // false while defaults are read
    std::map<std::string, std::vector<Name>> names_;  // defined under "materials", "walls", ...
    std::vector<std::pair<std::string, Name>> references_;
};

}  // namespace scree::io
