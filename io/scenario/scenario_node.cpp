#include "io/scenario/scenario_node.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace scree::io {
namespace {

template <class T>
const T& get(const Node& node, std::string_view wanted) {
    if (const T* value = std::get_if<T>(&node.value)) return *value;
    throw InternalError(fmt::format("the scenario's '{}' was asked for as {}, which it is not", node.path, wanted));
}

}  // namespace

bool Node::has(std::string_view key) const {
    const Map& map = get<Map>(*this, "a map");
    return map.find(key) != map.end();
}

const Node& Node::at(std::string_view key) const {
    const Map& map = get<Map>(*this, "a map");
    const auto found = map.find(key);
    if (found == map.end()) {
        throw InternalError(fmt::format("the scenario's '{}' was asked for '{}', which it does not have", path, key));
    }
    return found->second;
}

const Node& Node::at(std::size_t i) const {
    const List& list = items();
    if (i >= list.size()) {
        throw InternalError(fmt::format("the scenario's '{}' has {} items, not {}", path, list.size(), i + 1));
    }
    return list[i];
}

std::size_t Node::size() const {
    return items().size();
}
const Node::List& Node::items() const {
    return get<List>(*this, "a list");
}

double Node::number() const {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
    return get<double>(*this, "a number");
}

std::int64_t Node::integer() const {
    return get<std::int64_t>(*this, "an integer");
}
bool Node::boolean() const {
    return get<bool>(*this, "true or false");
}
const std::string& Node::text() const {
    return get<std::string>(*this, "a text");
}
Vec3 Node::vector() const {
    return get<Vec3>(*this, "a vector");
}

}  // namespace scree::io
