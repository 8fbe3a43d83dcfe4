// What all builders share: where faults go, the scenario's folder, the local origin, the names of the materials, the
// shapes; and small helpers on nodes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/ids.hpp"
#include "core/make_shape.hpp"
#include "core/random.hpp"
#include "core/vec.hpp"
#include "io/scenario/diagnostics.hpp"
#include "io/scenario/scenario_node.hpp"

namespace scree::scenarios {

// An item of `shapes`.
struct NamedShape {
    std::string name;
    std::vector<PlacedShape> variants;  // a body takes one of them; none: it is faulty, which has been reported

    std::size_t draw_variant(Random& random) const {
        return static_cast<std::size_t>(random.uniform() * static_cast<double>(variants.size()));
    }
};

struct Context {
    io::Diagnostics& diagnostics;
    std::string folder;  // of the scenario file
    std::uint64_t seed = 1;
    Vec3 origin = Vec3::Zero();          // [m] taken from every position of the file
    std::vector<std::string> materials;  // by MaterialIndex
    std::vector<NamedShape> shapes{};

    void error(const io::Node& node, const std::string& message) const;
    void warning(const io::Node& node, const std::string& message) const;
    std::size_t errors() const { return diagnostics.error_count(); }

    // A position in the local frame [m].
    Vec3 point(const io::Node& node) const { return node.vector() - origin; }
    // The unit vector of a direction; an error if it has no length.
    Vec3 direction(const io::Node& node) const;
    // The material of this name; an error (and material 0) if there is none.
    MaterialIndex material(const io::Node& name) const;
    // The index in `shapes` of a name that the reader has checked.
    std::size_t shape(const io::Node& name) const;
    // The index of a name; an error that names the nearest one (and 0) if it is unknown.
    std::size_t find(const io::Node& name, const std::vector<std::string>& names, std::string_view what) const;
    // Errors at each `name` that an earlier item has.
    void check_unique_names(const io::Node::List& items, std::string_view what) const;
    // An error unless map[low] < map[high]. Absent keys are no fault.
    void check_ascending(const io::Node& map, std::string_view low, std::string_view high) const;
};

// The items of a list that may be absent.
const io::Node::List& items_of(const io::Node& map, std::string_view key);

double number_or(const io::Node& map, std::string_view key, double otherwise);
Vec3 vector_or(const io::Node& map, std::string_view key, const Vec3& otherwise);

}  // namespace scree::scenarios
