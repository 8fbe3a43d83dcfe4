// Quantities with units: "6 mm", "2.65 g/cm3", "30 rpm". A closed list of units; a bare number is SI.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scree::io {

enum class Dimension {
    none,
    length,
    time,
    mass,
    velocity,
    acceleration,
    angle,
    angular_velocity,
    frequency,
    density,
    mass_rate,
    force,
    pressure,
    energy,
    volume,
};

// "length", "angular velocity", ...: as it stands in messages. "number" for none.
std::string_view dimension_name(Dimension dimension);
// The SI unit of bare numbers: "m", "kg/m3"; "" for none.
std::string_view si_unit(Dimension dimension);
// Every unit of a dimension, the SI unit first.
std::vector<std::string> units_of(Dimension dimension);

// Either a finite value in SI, or what is wrong with the text (without place or key).
struct ParsedQuantity {
    std::optional<double> value;
    std::string problem;
};
// A number alone. Refuses nan, inf, and what a double cannot hold.
ParsedQuantity parse_number(std::string_view text);
// A number, or a number with a unit of `dimension`. Powers may be written with ^ ("g/cm^3").
ParsedQuantity parse_quantity(std::string_view text, Dimension dimension);

}  // namespace scree::io
