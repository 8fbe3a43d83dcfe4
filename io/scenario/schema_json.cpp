#include "io/scenario/schema_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/scenario/schema.hpp"
#include "io/scenario/schema_text.hpp"

namespace scree::io {
namespace {

using Json = nlohmann::ordered_json;

Json reference_to(const std::string& name) {
    return {{"$ref", "#/definitions/" + name}};
}

Json bounded(Json schema, const Range& range) {
    if (range.bounded_below()) schema[range.above_lower ? "exclusiveMinimum" : "minimum"] = range.lower;
    if (range.bounded_above()) schema["maximum"] = range.upper;
    return schema;
}

// A number in SI, or a text with a unit.
Json quantity(Dimension dimension, const Range& range) {
    Json number = bounded({{"type", "number"}}, range);
    if (dimension == Dimension::none) return number;
    std::string units;
    for (const std::string& unit : units_of(dimension)) units += (units.empty() ? "" : "|") + unit;
    const std::string pattern =
        fmt::format("^\\s*[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?\\s*({})?\\s*$", units);
    return {{"anyOf", Json::array({number, Json{{"type", "string"}, {"pattern", pattern}}})}};
}

Json list_of(Json items, std::size_t length) {
    Json list{{"type", "array"}, {"items", std::move(items)}};
    if (length != 0) list["minItems"] = list["maxItems"] = length;
    return list;
}

Json table(const Row& row) {
    Json cells = Json::array();
    for (const Column& column : row.columns) cells.push_back(quantity(column.dimension, column.range));
    const std::size_t width = cells.size();
    Json list{{"type", "array"}, {"minItems", 1}, {"items", list_of(std::move(cells), width)}};
    return list;
}

Json text(const Row& row) {
    Json schema{{"type", "string"}};
    if (row.is_unique) schema["pattern"] = "^[^\\s.:;,/\\\\\"'\\[\\](){}=+*#&!?%$@<>|~^`]+$";
    if (row.is_file || !row.refers_to.empty()) schema["minLength"] = 1;
    return schema;
}

Json value(const Row& row) {
    const Json number = quantity(row.dimension, row.range);
    switch (row.kind) {
        case Kind::boolean:
            return {{"type", "boolean"}};
        case Kind::integer:
            return bounded({{"type", "integer"}}, row.range);
        case Kind::number:
            return number;
        case Kind::vector:
            return list_of(number, 3);
        case Kind::number_or_vector:
            return {{"anyOf", Json::array({number, list_of(number, 3)})}};
        case Kind::texts:
            return list_of(text(row), row.length);
        case Kind::text_or_texts:
            return {{"anyOf", Json::array({text(row), list_of(text(row), 0)})}};
        case Kind::choice:
            return {{"enum", row.choices}};
        case Kind::choices:
            return list_of({{"enum", row.choices}}, 0);
        case Kind::integers:
            return list_of(bounded({{"type", "integer"}}, row.range), row.length);
        case Kind::numbers:
            return list_of(number, row.length);
        case Kind::table:
            return table(row);
        default:
            return text(row);
    }
}

void add_rules(Json& schema, const std::vector<const Rule*>& rules) {
    for (const Rule* rule : rules) {
        if (rule->kind == Rule::Kind::ascending) continue;  // JSON Schema cannot compare two values
        if (rule->kind == Rule::Kind::at_most_one) {
            Json pairs = Json::array();
            for (std::size_t i = 0; i < rule->keys.size(); ++i)
                for (std::size_t k = 0; k < i; ++k)
                    pairs.push_back({{"required", Json::array({rule->keys[k], rule->keys[i]})}});
            schema["not"] = pairs.size() == 1 ? pairs.front() : Json{{"anyOf", pairs}};
            continue;
        }
        const char* const some = rule->kind == Rule::Kind::exactly_one ? "oneOf" : "anyOf";
        for (const std::string& key : rule->keys) schema[some].push_back(Json{{"required", Json::array({key})}});
    }
}

class Generator {
  public:
    Json scenario() {
        const SchemaNode& root = schema_root();
        Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
                    {"title", "Scree scenario"},
                    {"type", "object"},
                    {"additionalProperties", false}};
        // What a file lacks may come from the files that it includes: required keys only where there are none.
        for (const SchemaNode* key : root.keys) schema["properties"][key->key] = described(*key, false);
        add_rules(schema, root.rules);
        Json whole = requirements(root);
        for (const SchemaNode* key : root.keys) {
            Json inner = requirements(*key);
            if (inner.empty()) continue;
            if (key->row->kind == Kind::named) inner = {{"additionalProperties", std::move(inner)}};
            if (key->row->kind == Kind::named || key->row->kind == Kind::section) whole["properties"][key->key] = inner;
        }
        schema["if"] = {{"required", Json::array({"include"})}};
        schema["then"] = Json::object();
        schema["else"] = std::move(whole);
        for (const SchemaNode* shared : shared_sections()) schema["definitions"][shared->key] = section(*shared, true);
        return schema;
    }

  private:
    static Json requirements(const SchemaNode& node) {
        Json names = Json::array();
        for (const SchemaNode* key : node.keys) {
            if (key->row->is_required) names.push_back(key->key);
        }
        return names.empty() ? Json::object() : Json{{"required", std::move(names)}};
    }

    // `strict`: required keys are asked for here, not by the `else` of the root.
    Json described(const SchemaNode& node, bool strict) {
        const Row& row = *node.row;
        Json schema;
        switch (row.kind) {
            case Kind::section:
                if (!row.same_as.empty() && row.only.empty()) {
                    schema = {{"allOf", Json::array({reference_to(row.same_as)})}};
                } else {
                    schema = section(node, strict);
                }
                break;
            case Kind::named:
                schema = {{"type", "object"}, {"additionalProperties", section(node, strict)}};
                break;
            case Kind::list:
                schema = {{"type", "array"}, {"items", section(node, true)}};
                break;
            default:
                schema = value(row);
        }
        schema["description"] = fmt::format("{}\nExpected: {}.", row.doc, expectation(node));
        if (!row.standard.empty() && row.kind != Kind::section && row.kind != Kind::list) {
            schema["default"] = default_value(row);
        }
        return schema;
    }

    // Most defaults are JSON as they stand; bare words are texts.
    static Json default_value(const Row& row) {
        Json parsed = Json::parse(row.standard, nullptr, false);
        return parsed.is_discarded() ? Json(row.standard) : parsed;
    }

    Json section(const SchemaNode& node, bool strict) {
        if (!node.variants.empty()) return forms(node, strict);
        Json schema{{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
        for (const SchemaNode* key : node.keys) schema["properties"][key->key] = described(*key, strict);
        if (strict) schema.update(requirements(node));
        add_rules(schema, node.rules);
        return schema;
    }

    // One `if` for each form, so that an editor shows the keys and the faults of the form that is meant.
    Json forms(const SchemaNode& node, bool strict) {
        Json any{{"enum", node.variant_names()}};
        std::string meanings;
        for (const SchemaNode* form : node.variants) meanings += fmt::format("{}: {}\n", form->key, form->row->doc);
        any["description"] = meanings;
        Json schema{{"type", "object"},
                    {"required", Json::array({node.variant_key})},
                    {"properties", {{node.variant_key, any}}}};
        for (const SchemaNode* form : node.variants) {
            SchemaNode whole = *form;
            whole.keys = node.keys;
            whole.keys.insert(whole.keys.end(), form->keys.begin(), form->keys.end());
            Json then = section(whole, strict);
            then["properties"][node.variant_key] = {{"const", form->key}};
            const Json is_form{{"properties", {{node.variant_key, {{"const", form->key}}}}},
                               {"required", Json::array({node.variant_key})}};
            schema["allOf"].push_back({{"if", is_form}, {"then", std::move(then)}});
        }
        return schema;
    }
};

}  // namespace

std::string schema_json() {
    return Generator().scenario().dump(2) + "\n";
}

}  // namespace scree::io
