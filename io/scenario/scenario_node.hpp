// A scenario after reading: a tree of checked values in SI units, every default filled in, each with its place in the
// file. Made by io/scenario_reader, consumed by scenarios/.
//
// A node is a map, a list, or a value. In a list of variants (walls, bodies, ...) each item is a map that carries the
// name of its variant: the `shape: plane` of a wall. Asking a node for what it is not is a fault of the program, not of
// the user: the reader has checked kinds, ranges and required keys against the schema table (io/scenario/schema.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/vec.hpp"

namespace scree::io {

// A place in a file: 1-based line and column; line 0: no place (a default, a command-line override names itself in
// `file`).
struct Mark {
    std::string file;
    int line = 0;
    int column = 0;
};

class Node {
  public:
    using Map = std::map<std::string, Node, std::less<>>;
    using List = std::vector<Node>;

    std::variant<std::monostate, bool, std::int64_t, double, std::string, Vec3, List, Map> value;
    Mark mark;
    std::string path;    // "walls[2].radius"
    bool given = false;  // written by the user, not a default

    bool has(std::string_view key) const;        // map: the key is there (given, or has a default)
    const Node& at(std::string_view key) const;  // map
    const Node& at(std::size_t i) const;         // list
    std::size_t size() const;                    // list
    const List& items() const;                   // list

    double number() const;  // SI
    std::int64_t integer() const;
    bool boolean() const;
    const std::string& text() const;
    Vec3 vector() const;  // three numbers, SI

    // Shorthands: at(key).number() and so on.
    double number(std::string_view key) const { return at(key).number(); }
    std::int64_t integer(std::string_view key) const { return at(key).integer(); }
    bool boolean(std::string_view key) const { return at(key).boolean(); }
    const std::string& text(std::string_view key) const { return at(key).text(); }
    Vec3 vector(std::string_view key) const { return at(key).vector(); }
};

}  // namespace scree::io
