// The scenario's keys in one table: path, kind, unit, range, default, meaning. The reader, `explain`, the JSON Schema
// and the reference page are all made from it (schema_rows_*.cpp hold the rows, schema.cpp hangs them into a tree).
//
// Paths:  time.step              a key of a section
//         materials.*.density    a key of each section that the user names
//         pairs[].friction       a key of each item of a list
//         walls[plane].normal    a key of the items of a list whose `shape` is `plane`
//         REGION[box].lower      a key of a section that several places share
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "io/scenario/quantity.hpp"

namespace scree::io {

// In brackets: what the reader puts into the node.
enum class Kind {
    section,           // a map with the keys below it
    named,             // a map from names that the user chooses to sections
    list,              // a list of sections
    variant,           // one of the forms that a section can take; picked by the section's `variant_key`
    boolean,           // [bool]
    integer,           // [int64]
    number,            // [double, SI] with a dimension: "6 mm" too
    vector,            // [Vec3, SI] three numbers
    number_or_vector,  // [Vec3, SI] one number stands for all three
    text,              // [string]
    text_or_texts,     // [list of strings]
    texts,             // [list of strings]
    choice,            // [string] one of `choices`
    choices,           // [list of strings] each one of `choices`
    integers,          // [list of int64]
    numbers,           // [list of double, SI]
    table,             // [list of lists of double] rows with `columns`
};

struct Range {
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
    bool above_lower = false;  // the lower bound itself is out

    bool contains(double x) const { return (above_lower ? x > lower : x >= lower) && x <= upper; }
    bool bounded_below() const { return lower > -std::numeric_limits<double>::infinity(); }
    bool bounded_above() const { return upper < std::numeric_limits<double>::infinity(); }
    std::string text() const;  // "> 0", "0 to 1"
};

struct Column {
    std::string name;
    Dimension dimension = Dimension::none;
    Range range;
};

// One row of the table. The functions after the data set them, so that a row reads as a sentence.
struct Row {
    std::string path;
    Kind kind = Kind::section;
    Dimension dimension = Dimension::none;
    bool is_required = false;
    std::string standard;              // the default, as YAML in SI; "": the key is absent unless given
    std::string when_absent;           // what absence means, for the reader of the documentation
    Range range;                       // of a number, or of each component
    std::vector<std::string> choices;  // of choice and choices
    std::size_t length = 0;            // of lists; 0: any
    std::vector<Column> columns;       // of table
    std::string variant_key;           // the key whose value picks the form of the section
    std::string same_as;               // the shared section whose keys these are
    std::vector<std::string> only;     // of the shared section's forms, those allowed here; empty: all
    std::string refers_to;             // the text is a name defined under this key ("materials", "walls")
    bool is_unique = false;            // the text is the item's name: short, and no other item's
    bool is_nonzero = false;           // the vector must have a length
    bool is_file = false;              // the text is the path of a file, relative to the file that names it
    std::string doc;                   // meaning, and what happens when it is changed

    Row in(Range r) &&;
    Row required() &&;
    Row standardly(std::string yaml) &&;
    Row or_else(std::string meaning) &&;
    Row nonzero() &&;
    Row unique() &&;
    Row naming_file() &&;
    Row naming(std::string key) &&;
    Row picked_by(std::string key) &&;
    Row like(std::string shared, std::vector<std::string> forms = {}) &&;
    Row says(std::string sentence) &&;
};

// What several keys of one section must satisfy together.
struct Rule {
    enum class Kind { exactly_one, at_most_one, ascending } kind;
    std::string where;  // the section's path; "": the whole scenario
    std::vector<std::string> keys;
};

const std::vector<Row>& schema_rows();
const std::vector<Rule>& schema_rules();

// The same rows as a tree. Shared sections are entered where they are used.
struct SchemaNode {
    const Row* row = nullptr;
    std::string key;                          // last part of the path; the form's name of a variant
    std::vector<const SchemaNode*> keys;      // in the order of the table; of list and named: those of each item
    std::vector<const SchemaNode*> variants;  // forms; their keys come after the common ones
    std::string variant_key;                  // picks the form; "" if there are none
    std::vector<const Rule*> rules;

    const SchemaNode* find_key(std::string_view name) const;
    const SchemaNode* find_variant(std::string_view name) const;
    std::vector<std::string> variant_names() const;
};
// The whole scenario; and a shared section ("REGION", "SIZE") by name.
const SchemaNode& schema_root();
const std::vector<const SchemaNode*>& shared_sections();

}  // namespace scree::io
