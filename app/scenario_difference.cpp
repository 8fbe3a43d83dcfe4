#include "app/scenario_difference.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace scree::app {
namespace {

using io::Node;

struct Comparer {
    std::vector<std::string>& paths;

    void maps(const Node::Map& a, const Node::Map& b, const std::string& path) {
        const auto below = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
        for (const auto& [key, node] : a) {
            const auto other = b.find(key);
            if (other == b.end()) {
                paths.push_back(below(key));
            } else {
                nodes(node, other->second, below(key));
            }
        }
        for (const auto& [key, node] : b) {
            if (!a.contains(key)) paths.push_back(below(key));
        }
    }

    void lists(const Node::List& a, const Node::List& b, const std::string& path) {
        if (a.size() != b.size()) paths.push_back(path);
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            nodes(a[i], b[i], fmt::format("{}[{}]", path, i));
    }

    void nodes(const Node& a, const Node& b, const std::string& path) {
        if (a.value.index() != b.value.index()) {
            paths.push_back(path);
        } else if (const auto* map = std::get_if<Node::Map>(&a.value)) {
            maps(*map, std::get<Node::Map>(b.value), path);
        } else if (const auto* list = std::get_if<Node::List>(&a.value)) {
            lists(*list, std::get<Node::List>(b.value), path);
        } else if (!same_value(a, b)) {
            paths.push_back(path);
        }
    }

    static bool same_value(const Node& a, const Node& b) {
        return std::visit(
            [&b](const auto& value) {
                using T = std::decay_t<decltype(value)>;
                if constexpr (std::is_same_v<T, Node::Map> || std::is_same_v<T, Node::List>) {
                    return false;  // compared above
                } else {
                    return value == std::get<T>(b.value);
                }
            },
            a.value);
    }
};

}  // namespace

std::vector<std::string> differing_keys(const Node& a, const Node& b) {
    std::vector<std::string> paths;
    Comparer{paths}.nodes(a, b, "");
    return paths;
}

bool may_change_on_resume(std::string_view path) {
    // The fields decide whether orientations are followed, which a checkpoint made without them cannot give.
    if (path.starts_with("output.fields")) return false;
    return path == "time.end" || path == "title" || path == "description" || path == "output" ||
           path.starts_with("output.");
}

}  // namespace scree::app
