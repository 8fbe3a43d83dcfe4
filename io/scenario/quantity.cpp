#include "io/scenario/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace scree::io {
namespace {

// value in SI = number * up / down. Two factors, because 9 / 1000 is the double nearest to 0.009 and 9 * 0.001 is not.
struct Unit {
    std::string_view name;
    Dimension dimension;
    double up, down;
};

constexpr double kPi = std::numbers::pi;
constexpr std::array kUnits{
    Unit{"m", Dimension::length, 1, 1},
    Unit{"cm", Dimension::length, 1, 100},
    Unit{"mm", Dimension::length, 1, 1e3},
    Unit{"um", Dimension::length, 1, 1e6},
    Unit{"km", Dimension::length, 1e3, 1},
    Unit{"s", Dimension::time, 1, 1},
    Unit{"ms", Dimension::time, 1, 1e3},
    Unit{"us", Dimension::time, 1, 1e6},
    Unit{"min", Dimension::time, 60, 1},
    Unit{"h", Dimension::time, 3600, 1},
    Unit{"kg", Dimension::mass, 1, 1},
    Unit{"g", Dimension::mass, 1, 1e3},
    Unit{"mg", Dimension::mass, 1, 1e6},
    Unit{"t", Dimension::mass, 1e3, 1},
    Unit{"m/s", Dimension::velocity, 1, 1},
    Unit{"mm/s", Dimension::velocity, 1, 1e3},
    Unit{"cm/s", Dimension::velocity, 1, 100},
    Unit{"km/h", Dimension::velocity, 1e3, 3600},
    Unit{"m/s2", Dimension::acceleration, 1, 1},
    Unit{"rad", Dimension::angle, 1, 1},
    Unit{"deg", Dimension::angle, kPi, 180},
    Unit{"rad/s", Dimension::angular_velocity, 1, 1},
    Unit{"deg/s", Dimension::angular_velocity, kPi, 180},
    Unit{"rpm", Dimension::angular_velocity, kPi, 30},
    Unit{"Hz", Dimension::frequency, 1, 1},
    Unit{"kg/m3", Dimension::density, 1, 1},
    Unit{"g/cm3", Dimension::density, 1e3, 1},
    Unit{"t/m3", Dimension::density, 1e3, 1},
    Unit{"kg/s", Dimension::mass_rate, 1, 1},
    Unit{"g/s", Dimension::mass_rate, 1, 1e3},
    Unit{"kg/h", Dimension::mass_rate, 1, 3600},
    Unit{"t/h", Dimension::mass_rate, 1e3, 3600},
    Unit{"N", Dimension::force, 1, 1},
    Unit{"kN", Dimension::force, 1e3, 1},
    Unit{"Pa", Dimension::pressure, 1, 1},
    Unit{"kPa", Dimension::pressure, 1e3, 1},
    Unit{"MPa", Dimension::pressure, 1e6, 1},
    Unit{"GPa", Dimension::pressure, 1e9, 1},
    Unit{"J", Dimension::energy, 1, 1},
    Unit{"m3", Dimension::volume, 1, 1},
    Unit{"L", Dimension::volume, 1, 1e3},
    Unit{"cm3", Dimension::volume, 1, 1e6},
    Unit{"mm3", Dimension::volume, 1, 1e9},
};

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool is_non_finite_word(std::string_view text) {
    if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
    if (!text.empty() && text.front() == '.') text.remove_prefix(1);
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    return lower == "nan" || lower == "inf" || lower == "infinity";
}

// The number at the start of `text`, and how many characters it took (0: there is none).
struct Leading {
    ParsedQuantity number;
    std::size_t length = 0;
};
Leading leading_number(std::string_view text) {
    const std::size_t sign = !text.empty() && text.front() == '+' ? 1 : 0;
    const bool starts = text.size() > sign && (std::isdigit(static_cast<unsigned char>(text[sign])) != 0 ||
                                               text[sign] == '.' || (sign == 0 && text[sign] == '-'));
    double value = 0.0;
    const auto result = std::from_chars(text.data() + sign, text.data() + text.size(), value);
    if (!starts || result.ec == std::errc::invalid_argument) return {};
    const auto length = static_cast<std::size_t>(result.ptr - text.data());
    if (result.ec == std::errc::result_out_of_range) {
        return {{{}, fmt::format("{} is beyond the range of double precision", text.substr(0, length))}, length};
    }
    if (!std::isfinite(value)) return {};
    return {{value, {}}, length};
}

}  // namespace

std::string_view dimension_name(Dimension dimension) {
    constexpr std::array<std::string_view, 15> names{
        "number",    "length",  "time",      "mass",  "velocity", "acceleration", "angle", "angular velocity",
        "frequency", "density", "mass rate", "force", "pressure", "energy",       "volume"};
    return names[static_cast<std::size_t>(dimension)];
}

std::string_view si_unit(Dimension dimension) {
    const auto* unit =
        std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& u) { return u.dimension == dimension; });
    return unit == kUnits.end() ? std::string_view() : unit->name;
}

std::vector<std::string> units_of(Dimension dimension) {
    std::vector<std::string> names;
    for (const Unit& unit : kUnits) {
        if (unit.dimension == dimension) names.emplace_back(unit.name);
    }
    return names;
}

ParsedQuantity parse_number(std::string_view text) {
    text = trimmed(text);
    if (is_non_finite_word(text)) return {{}, fmt::format("{} is not finite", text)};
    const Leading leading = leading_number(text);
    if (leading.length == 0 || leading.length != text.size()) return {{}, fmt::format("'{}' is not a number", text)};
    return leading.number;
}

ParsedQuantity parse_quantity(std::string_view text, Dimension dimension) {
    text = trimmed(text);
    const Leading leading = leading_number(text);
    if (leading.length == 0 || leading.length == text.size()) return parse_number(text);
    if (!leading.number.value) return leading.number;

    std::string name(trimmed(text.substr(leading.length)));
    std::erase(name, '^');
    const auto* unit = std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& u) { return u.name == name; });
    const bool is_word = !name.empty() && (std::isalpha(static_cast<unsigned char>(name.front())) != 0 ||
                                           static_cast<unsigned char>(name.front()) >= 0x80U);
    if (unit == kUnits.end() && (!is_word || dimension == Dimension::none)) {
        return {{}, fmt::format("'{}' is not a number", text)};
    }
    if (unit == kUnits.end()) return {{}, fmt::format("'{}' is not a unit", name)};
    if (unit->dimension != dimension) {
        return {{}, fmt::format("'{}' is a {}", text, dimension_name(unit->dimension))};
    }
    const double value = *leading.number.value * unit->up / unit->down;
    if (!std::isfinite(value)) return {{}, fmt::format("{} is beyond the range of double precision", text)};
    return {value, {}};
}

}  // namespace scree::io
