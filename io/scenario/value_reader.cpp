#include "io/scenario/value_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/scenario/schema_text.hpp"
#include "io/scenario/utf8.hpp"

namespace scree::io {
namespace {

using YamlKind = YamlValue::Kind;

std::string shortened(const std::string& text) {
    constexpr std::size_t most = 60;
    if (text.size() <= most) return text;
    std::size_t end = most;
    while (end > 0 && !begins_character(text[end])) --end;
    return text.substr(0, end) + "...";
}

Node node_of(const YamlValue& yaml, const std::string& path) {
    Node node;
    node.mark = yaml.mark;
    node.path = path;
    node.given = true;
    return node;
}

bool is_word(std::string_view text, std::initializer_list<std::string_view> words) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    return std::find(words.begin(), words.end(), lower) != words.end();
}

}  // namespace

std::string describe(const YamlValue& yaml) {
    switch (yaml.kind) {
        case YamlKind::null:
            return "no value";
        case YamlKind::list:
            return "a list";
        case YamlKind::map:
            return "a map";
        case YamlKind::scalar:
            break;
    }
    return fmt::format("'{}'", shortened(yaml.text));
}

void ValueReader::refuse(const Mark& mark, const std::string& path, const std::string& problem,
                         const std::string& expected) {
    diagnostics_.error(mark, fmt::format("{}: {}; expected {}", path, problem, expected));
}

bool ValueReader::read(const SchemaNode& schema, const YamlValue& yaml, const std::string& path, Node& node) {
    const Row& row = *schema.row;
    switch (row.kind) {
        case Kind::boolean:
            return read_boolean(schema, yaml, path, node.value.emplace<bool>());
        case Kind::integer:
            return read_integer(row, yaml, path, node.value.emplace<std::int64_t>());
        case Kind::number:
            return read_number(row.dimension, row.range, yaml, path, node.value.emplace<double>());
        case Kind::number_or_vector:
            if (yaml.kind == YamlKind::scalar) {
                double number = 0.0;
                const bool good = read_number(row.dimension, row.range, yaml, path, number);
                node.value = Vec3(Vec3::Constant(number));
                return good;
            }
            return read_vector(schema, yaml, path, node.value.emplace<Vec3>());
        case Kind::vector:
            return read_vector(schema, yaml, path, node.value.emplace<Vec3>());
        case Kind::text:
        case Kind::choice:
            return read_text(schema, yaml, path, node.value.emplace<std::string>());
        case Kind::table:
            return read_table(schema, yaml, path, node);
        default:
            return read_list(schema, yaml, path, node);
    }
}

bool ValueReader::read_boolean(const SchemaNode& schema, const YamlValue& yaml, const std::string& path, bool& value) {
    const bool plain = yaml.kind == YamlKind::scalar && !yaml.quoted;
    value = plain && yaml.text == "true";
    if (value || (plain && yaml.text == "false")) return true;
    std::string problem = describe(yaml);
    if (plain && is_word(yaml.text, {"yes", "on", "y", "true"})) problem += " is not taken, write true";
    if (plain && is_word(yaml.text, {"no", "off", "n", "false"})) problem += " is not taken, write false";
    refuse(yaml.mark, path, problem, expectation(schema));
    return false;
}

bool ValueReader::read_integer(const Row& row, const YamlValue& yaml, const std::string& path, std::int64_t& value) {
    const auto fail = [&](const std::string& problem) {
        const std::string range = row.range.text();
        refuse(yaml.mark, path, problem, range.empty() ? "an integer" : "an integer " + range);
        return false;
    };
    if (yaml.kind != YamlKind::scalar) return fail(describe(yaml));
    if (yaml.quoted) return fail(describe(yaml) + " is a text, because of its quotes");
    const std::string& text = yaml.text;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size()) {  // 1e6, +3
        const ParsedQuantity number = parse_number(text);
        if (!number.value) return fail(number.problem);
        constexpr double most = 9007199254740992.0;  // up to here every double that is whole is exact
        if (*number.value != std::floor(*number.value)) return fail(describe(yaml) + " is not whole");
        if (std::abs(*number.value) > most) return fail(describe(yaml) + " is too large");
        value = static_cast<std::int64_t>(*number.value);
    }
    return row.range.contains(static_cast<double>(value)) || fail(describe(yaml) + " is out of range");
}

bool ValueReader::read_number(Dimension dimension, const Range& range, const YamlValue& yaml, const std::string& path,
                              double& value) {
    const auto fail = [&](const std::string& problem) {
        refuse(yaml.mark, path, problem, number_expectation(dimension, range));
        return false;
    };
    if (yaml.kind != YamlKind::scalar) return fail(describe(yaml));
    if (yaml.quoted && dimension == Dimension::none) return fail(describe(yaml) + " is a text, because of its quotes");
    const ParsedQuantity parsed = parse_quantity(yaml.text, dimension);
    if (!parsed.value) return fail(shortened(parsed.problem));
    value = *parsed.value;
    return range.contains(value) || fail(describe(yaml) + " is out of range");
}

bool ValueReader::read_vector(const SchemaNode& schema, const YamlValue& yaml, const std::string& path, Vec3& value) {
    const Row& row = *schema.row;
    value.setZero();
    if (yaml.kind != YamlKind::list || yaml.items.size() != 3) {
        const bool list = yaml.kind == YamlKind::list;
        const std::string problem = list ? fmt::format("a list of {}", yaml.items.size()) : describe(yaml);
        refuse(yaml.mark, path, problem, expectation(schema));
        return false;
    }
    bool good = true;
    for (std::size_t i = 0; i < 3; ++i) {
        double& component = value[static_cast<Eigen::Index>(i)];
        const std::string item = fmt::format("{}[{}]", path, i);
        good = read_number(row.dimension, row.range, yaml.items[i], item, component) && good;
    }
    if (good && row.is_nonzero && value.stableNorm() == 0.0) {
        refuse(yaml.mark, path, "a vector without length", expectation(schema));
        good = false;
    }
    return good;
}

bool ValueReader::read_text(const SchemaNode& schema, const YamlValue& yaml, const std::string& path,
                            std::string& value) {
    const Row& row = *schema.row;
    if (yaml.kind != YamlKind::scalar) {
        refuse(yaml.mark, path, describe(yaml), expectation(schema));
        return false;
    }
    value = yaml.text;
    if (row.kind == Kind::choice || row.kind == Kind::choices) {
        const auto& choices = row.choices;
        if (std::find(choices.begin(), choices.end(), value) != choices.end()) return true;
        const std::string nearest = nearest_name(value, choices);
        const std::string hint = nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest);
        refuse(yaml.mark, path, describe(yaml) + hint, fmt::format("one of {}", fmt::join(choices, ", ")));
        return false;
    }
    const bool is_truth = !yaml.quoted && is_word(value, {"true", "false"});
    if (!yaml.quoted && (is_truth || parse_number(value).value)) {
        refuse(yaml.mark, path, fmt::format("{} is no text without quotes", describe(yaml)),
               fmt::format("a text: write \"{}\"", shortened(value)));
        return false;
    }
    if ((row.is_file || !row.refers_to.empty()) && value.empty()) {
        refuse(yaml.mark, path, "an empty text", expectation(schema));
        return false;
    }
    return !row.is_unique || check_name(value, yaml.mark, path);
}

bool ValueReader::check_name(const std::string& name, const Mark& mark, const std::string& path) {
    const auto fits = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ||
               static_cast<unsigned char>(c) >= 0x80U;
    };
    if (!name.empty() && std::all_of(name.begin(), name.end(), fits)) return true;
    refuse(mark, path, fmt::format("'{}' cannot be a name", shortened(name)), "letters, digits, '_' and '-'");
    return false;
}

bool ValueReader::read_list(const SchemaNode& schema, const YamlValue& yaml, const std::string& path, Node& node) {
    const Row& row = *schema.row;
    auto& list = node.value.emplace<Node::List>();
    const bool alone = row.kind == Kind::text_or_texts && yaml.kind == YamlKind::scalar;
    const std::size_t size = alone ? 1 : yaml.items.size();
    if ((yaml.kind != YamlKind::list && !alone) || (row.length != 0 && size != row.length)) {
        const bool is_list = yaml.kind == YamlKind::list;
        const std::string problem = is_list ? fmt::format("a list of {}", size) : describe(yaml);
        refuse(yaml.mark, path, problem, expectation(schema));
        return false;
    }
    bool good = true;
    for (std::size_t i = 0; i < size; ++i) {
        const YamlValue& item = alone ? yaml : yaml.items[i];
        const std::string item_path = fmt::format("{}[{}]", path, i);
        Node& element = list.emplace_back(node_of(item, item_path));
        element.given = node.given;
        if (row.kind == Kind::integers) {
            good = read_integer(row, item, item_path, element.value.emplace<std::int64_t>()) && good;
        } else if (row.kind == Kind::numbers) {
            good = read_number(row.dimension, row.range, item, item_path, element.value.emplace<double>()) && good;
        } else {
            good = read_text(schema, item, item_path, element.value.emplace<std::string>()) && good;
        }
    }
    return good;
}

bool ValueReader::read_table(const SchemaNode& schema, const YamlValue& yaml, const std::string& path, Node& node) {
    auto& rows = node.value.emplace<Node::List>();
    if (yaml.kind != YamlKind::list || yaml.items.empty()) {
        const std::string problem = yaml.kind == YamlKind::list ? "an empty list" : describe(yaml);
        refuse(yaml.mark, path, problem, expectation(schema));
        return false;
    }
    bool good = true;
    for (std::size_t i = 0; i < yaml.items.size(); ++i) {
        Node& row = rows.emplace_back(node_of(yaml.items[i], fmt::format("{}[{}]", path, i)));
        good = read_row(*schema.row, yaml.items[i], row) && good;
    }
    return good;
}

bool ValueReader::read_row(const Row& row, const YamlValue& yaml, Node& node) {
    auto& numbers = node.value.emplace<Node::List>();
    if (yaml.kind != YamlKind::list || yaml.items.size() != row.columns.size()) {
        const bool is_list = yaml.kind == YamlKind::list;
        std::vector<std::string> names;
        for (const Column& column : row.columns) names.push_back(column.name);
        refuse(yaml.mark, node.path, is_list ? fmt::format("a list of {}", yaml.items.size()) : describe(yaml),
               fmt::format("a row [{}]", fmt::join(names, ", ")));
        return false;
    }
    bool good = true;
    for (std::size_t i = 0; i < row.columns.size(); ++i) {
        const Column& column = row.columns[i];
        Node& number = numbers.emplace_back(node_of(yaml.items[i], fmt::format("{}[{}]", node.path, i)));
        good =
            read_number(column.dimension, column.range, yaml.items[i], number.path, number.value.emplace<double>()) &&
            good;
    }
    return good;
}

}  // namespace scree::io
