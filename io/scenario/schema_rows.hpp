// For the files of the schema table alone: how a row is written, and the parts of the table.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/scenario/schema.hpp"

namespace scree::io::rows {

using enum Dimension;

Row row(Kind kind, std::string path, Dimension dimension = none);
Row section(std::string path);
Row list(std::string path);
Row variant(std::string path);
Row boolean(std::string path);
Row integer(std::string path);
Row number(std::string path, Dimension dimension = none);
Row vector(std::string path, Dimension dimension = none);
Row direction(std::string path);
Row text(std::string path);
Row choice(std::string path, std::vector<std::string> choices, Kind kind = Kind::choice);
Row choices(std::string path, std::vector<std::string> names);
Row listing(Kind kind, std::string path, std::size_t length);
Row numbers(std::string path, std::size_t length, Dimension dimension = none);
Row table(std::string path, std::vector<Column> columns);

inline constexpr double kNone = std::numeric_limits<double>::infinity();
inline constexpr Range kPositive{0.0, kNone, true};
inline constexpr Range kNotNegative{0.0, kNone, false};
inline constexpr Range from(double lower) {
    return {lower, kNone, false};
}
inline constexpr Range between(double lower, double upper) {
    return {lower, upper, false};
}

// The parts, in the order of the reference page.
std::vector<Row> run();        // what is not below: version, time, gravity, solver, correction
std::vector<Row> materials();  // and pairs
std::vector<Row> shapes();
std::vector<Row> bodies();
std::vector<Row> blocks();  // generators of many polyhedra
std::vector<Row> walls();
std::vector<Row> flows();  // outlets and inlets
std::vector<Row> measures();
std::vector<Row> rasters();
std::vector<Row> trajectories();
std::vector<Row> output();
std::vector<Row> shared();  // SIZE, REGION and ORIENTATION

}  // namespace scree::io::rows
