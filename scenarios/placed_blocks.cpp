#include "scenarios/placed_blocks.hpp"

#include <fmt/format.h>

#include "scenarios/named_shapes.hpp"
#include "scenarios/shapes/cut.hpp"

namespace scree::scenarios {

std::string name_of_generator(const io::Node& node) {
    return node.has("name") ? node.text("name") : node.path;
}

CommonState::CommonState(const io::Node& node, const Context& context)
    : material(context.material(node.at("material"))),
      velocity(vector_or(node, "velocity", Vec3::Zero())),
      spin(vector_or(node, "spin", Vec3::Zero())) {}

void add_blocks(const io::Node& node, const Context& context, const Communicator& ranks,
                std::vector<PlacedShape> blocks, BodyList& bodies) {
    const CommonState common(node, context);
    const Part part(blocks.size(), ranks);
    const std::string name = name_of_generator(node);
    std::size_t troubled = 0, first = 0;
    std::string trouble;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        const std::string found = trouble_with(blocks[k].shape);
        if (!found.empty() && troubled++ == 0) {
            first = k;
            trouble = found;
        }
        const ShapeIndex shape = bodies.add_shape(std::move(blocks[k].shape), name);
        if (part.has(k))
            bodies.add(bodies.next_id + k, shape, common.material, blocks[k].centre, blocks[k].rotation,
                       common.velocity, common.spin);
    }
    if (troubled != 0)
        context.warning(node, fmt::format("{} of {} blocks are thin or have very short edges; the first, body {}, {}",
                                          troubled, blocks.size(), bodies.next_id + first, trouble));
    bodies.next_id += blocks.size();
}

Polyhedron eroded(const PlacedShape& block, double depth) {
    constexpr double kThinnest = 1e-9;  // of the size
    Polyhedron body = polyhedron_of(block);
    const double thickness = kThinnest * extent_of(body.vertex).size();
    for (const ConvexShape::Face& face : block.shape.face) {
        if (body.face.empty()) break;
        const Vec3 normal = block.rotation * face.normal;
        body = cut_below(body, {normal, face.offset + normal.dot(block.centre) - depth}, thickness);
    }
    return body;
}

}  // namespace scree::scenarios
