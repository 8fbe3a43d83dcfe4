#include "core/convex_shape.hpp"

#include <algorithm>

namespace scree {

void link_vertices(ConvexShape& shape) {
    std::vector<std::vector<std::uint32_t>> joined(shape.vertex.size());
    for (const ConvexShape::Edge& edge : shape.edge) {
        joined[edge.from].push_back(edge.to);
        joined[edge.to].push_back(edge.from);
    }
    shape.link_begin = {0};
    shape.link.clear();
    for (auto& list : joined) {
        std::sort(list.begin(), list.end());
        shape.link.insert(shape.link.end(), list.begin(), list.end());
        shape.link_begin.push_back(static_cast<std::uint32_t>(shape.link.size()));
    }
}

}  // namespace scree
