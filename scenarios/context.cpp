#include "scenarios/context.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/errors.hpp"

namespace scree::scenarios {

void Context::error(const io::Node& node, const std::string& message) const {
    diagnostics.error(node.mark, node.path.empty() ? message : fmt::format("{}: {}", node.path, message));
}
void Context::warning(const io::Node& node, const std::string& message) const {
    diagnostics.warning(node.mark, node.path.empty() ? message : fmt::format("{}: {}", node.path, message));
}

Vec3 Context::direction(const io::Node& node) const {
    const Vec3 v = node.vector();
    const double length = v.stableNorm();
    if (!(length > 0.0)) {
        error(node, "is a direction and must not be zero");
        return Vec3::UnitZ();
    }
    return (v / length).normalized();
}

MaterialIndex Context::material(const io::Node& name) const {
    return MaterialIndex{static_cast<std::uint16_t>(find(name, materials, "material"))};
}

std::size_t Context::shape(const io::Node& name) const {
    const auto named = [&](const NamedShape& s) { return s.name == name.text(); };
    const auto found = std::find_if(shapes.begin(), shapes.end(), named);
    SCREE_CHECK(found != shapes.end());
    return static_cast<std::size_t>(found - shapes.begin());
}

std::size_t Context::find(const io::Node& name, const std::vector<std::string>& names, std::string_view what) const {
    const auto found = std::find(names.begin(), names.end(), name.text());
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    const std::string near = io::nearest_name(name.text(), names);
    if (near.empty()) {
        error(name, fmt::format("there is no {} '{}'; there are: {}", what, name.text(),
                                names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
    } else {
        error(name, fmt::format("there is no {} '{}' (did you mean '{}'?)", what, name.text(), near));
    }
    return 0;
}

void Context::check_unique_names(const io::Node::List& items, std::string_view what) const {
    std::map<std::string, const io::Node*> seen;
    for (const io::Node& item : items) {
        if (!item.has("name")) continue;
        const io::Node& name = item.at("name");
        const auto [first, is_new] = seen.emplace(name.text(), &name);
        if (!is_new) {
            error(name, fmt::format("a {} with the name '{}' is already on line {}", what, name.text(),
                                    first->second->mark.line));
        }
    }
}

void Context::check_ascending(const io::Node& map, std::string_view low, std::string_view high) const {
    if (!map.has(low) || !map.has(high)) return;
    if (map.number(low) < map.number(high)) return;
    error(map.at(high), fmt::format("must be more than {} ({:g}), is {:g}", low, map.number(low), map.number(high)));
}

const io::Node::List& items_of(const io::Node& map, std::string_view key) {
    static const io::Node::List kNone;
    return map.has(key) ? map.at(key).items() : kNone;
}

double number_or(const io::Node& map, std::string_view key, double otherwise) {
    return map.has(key) ? map.number(key) : otherwise;
}
Vec3 vector_or(const io::Node& map, std::string_view key, const Vec3& otherwise) {
    return map.has(key) ? map.vector(key) : otherwise;
}

}  // namespace scree::scenarios
