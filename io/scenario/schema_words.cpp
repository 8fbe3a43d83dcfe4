// What keys expect, in words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/scenario/schema_text.hpp"

namespace scree::io {
namespace {

std::string with_article(std::string_view name) {
    const bool vowel = std::string_view("aeio").find(name.front()) != std::string_view::npos;
    return fmt::format("{} {}", vowel ? "an" : "a", name);
}

std::string plural(std::string_view name) {
    if (name == "velocity") return "velocities";
    if (name == "angular velocity") return "angular velocities";
    return fmt::format("{}s", name);
}

std::string units(Dimension dimension) {
    return dimension == Dimension::none ? "" : fmt::format(" ({})", fmt::join(units_of(dimension), ", "));
}

std::string spaced(const Range& range) {
    const std::string text = range.text();
    return text.empty() ? text : " " + text;
}

std::string list_of(std::size_t length, const std::string& what) {
    return length == 0 ? "a list of " + what : fmt::format("a list of {} {}", length, what);
}

}  // namespace

std::string section_expectation(const SchemaNode& node) {
    if (!node.variants.empty()) {
        return fmt::format("a map with the key '{}', one of {}", node.variant_key,
                           fmt::join(node.variant_names(), ", "));
    }
    std::vector<std::string> names;
    for (const SchemaNode* key : node.keys) names.push_back(key->key);
    return fmt::format("a map with keys out of {}", fmt::join(names, ", "));
}

std::string number_expectation(Dimension dimension, const Range& range) {
    return with_article(dimension_name(dimension)) + spaced(range) + units(dimension);
}

std::string expectation(const SchemaNode& node) {
    const Row& row = *node.row;
    switch (row.kind) {
        case Kind::boolean:
            return "true or false";
        case Kind::integer:
            return "an integer" + spaced(row.range);
        case Kind::number:
            return number_expectation(row.dimension, row.range);
        case Kind::vector:
            if (row.is_nonzero) return "a direction: a list of three numbers, not all 0";
            return fmt::format("a list of three {}{}", plural(dimension_name(row.dimension)), units(row.dimension));
        case Kind::number_or_vector:
            return number_expectation(row.dimension, row.range) + ", or a list of three";
        case Kind::text:
            if (row.is_file) return "the path of a file";
            return row.refers_to.empty() ? "a text" : fmt::format("the name of one of the {}", row.refers_to);
        case Kind::text_or_texts:
            return "a text or a list of texts";
        case Kind::texts:
            return list_of(row.length, row.refers_to.empty() ? "texts" : "names of " + row.refers_to);
        case Kind::choice:
            return fmt::format("one of {}", fmt::join(row.choices, ", "));
        case Kind::choices:
            return fmt::format("a list out of {}", fmt::join(row.choices, ", "));
        case Kind::integers:
            return list_of(row.length, "integers" + spaced(row.range));
        case Kind::numbers:
            return list_of(row.length, plural(dimension_name(row.dimension)) + spaced(row.range)) +
                   units(row.dimension);
        case Kind::table: {
            std::vector<std::string> names;
            for (const Column& column : row.columns) names.push_back(column.name);
            return fmt::format("a list of rows [{}]", fmt::join(names, ", "));
        }
        case Kind::list:
            return "a list of maps";
        case Kind::named:
            return "a map from names to maps";
        case Kind::section:
        case Kind::variant:
            break;
    }
    return section_expectation(node);
}

}  // namespace scree::io
