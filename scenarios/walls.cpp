#include "scenarios/walls.hpp"

#include <fmt/format.h>

#include "contact/polyhedra/polyhedron_wall.hpp"
#include "core/errors.hpp"

namespace scree::scenarios {
namespace {

using Node = io::Node;

bool keeps_inside(const Node& node) {
    return !node.has("keeps") || node.text("keeps") == "inside";
}
bool is_true(const Node& node, std::string_view key) {
    return node.has(key) && node.boolean(key);
}
Vec3 direction_or_z(const Node& node, std::string_view key, const Context& context) {
    return node.has(key) ? context.direction(node.at(key)) : Vec3(Vec3::UnitZ());
}

WallShape build_box(const Node& node, const Context& context) {
    const BoxWall box{context.point(node.at("lower")), context.point(node.at("upper")), keeps_inside(node),
                      is_true(node, "open_top"), is_true(node, "open_bottom")};
    if (!(box.lower.array() < box.upper.array()).all()) {
        context.error(node.at("upper"), "must be more than lower on every axis");
    }
    for (const char* key : {"open_top", "open_bottom"}) {
        if (!box.inside && is_true(node, key)) {
            context.error(node.at(key), "a box that keeps bodies outside has all its faces; use keeps: inside");
        }
    }
    return box;
}

WallShape build_cone(const Node& node, const Context& context) {
    const ConeWall cone{context.point(node.at("base")), direction_or_z(node, "axis", context),
                        node.number("radius_base"),     node.number("radius_end"),
                        node.number("length"),          keeps_inside(node)};
    if (cone.radius_base <= 0.0 && cone.radius_end <= 0.0) {
        context.error(node.at("radius_end"), "one of radius_base and radius_end must be above 0");
    }
    return cone;
}

WallShape build_slot(const Node& node, const Context& context) {
    SlotFloor slot{context.point(node.at("centre")), direction_or_z(node, "normal", context), Vec3::UnitX(),
                   node.number("width"), number_or(node, "length", kForever)};
    if (node.has("along")) slot.along = context.direction(node.at("along"));
    const Vec3 in_plane = slot.along - slot.along.dot(slot.normal) * slot.normal;
    if (in_plane.norm() < 1e-9) {
        context.error(node.has("along") ? node.at("along") : node.at("normal"),
                      "the slot's direction `along` must not be parallel to its normal");
        return slot;
    }
    slot.along = in_plane.normalized();
    return slot;
}

WallShape build_shape(const Node& node, const Context& context) {
    const std::string& shape = node.text("shape");
    if (shape == "plane") return PlaneWall{context.point(node.at("point")), context.direction(node.at("normal"))};
    if (shape == "box") return build_box(node, context);
    if (shape == "cylinder") {
        return CylinderWall{context.point(node.at("base")), direction_or_z(node, "axis", context),
                            node.number("radius"), number_or(node, "length", kForever), keeps_inside(node)};
    }
    if (shape == "cone") return build_cone(node, context);
    if (shape == "disc") {
        return DiscWall{context.point(node.at("centre")), direction_or_z(node, "normal", context),
                        node.number("radius")};
    }
    if (shape == "orifice_floor") {
        return OrificeFloor{context.point(node.at("centre")), direction_or_z(node, "normal", context),
                            0.5 * node.number("hole_diameter")};
    }
    SCREE_CHECK(shape == "slot_floor");
    return build_slot(node, context);
}

WallMotion build_motion(const Node& node, const Context& context) {
    WallMotion m;
    m.velocity = vector_or(node, "velocity", m.velocity);
    m.amplitude = vector_or(node, "amplitude", m.amplitude);
    m.frequency = number_or(node, "frequency", 0.0);
    m.phase = number_or(node, "phase", 0.0);
    m.rate = number_or(node, "rate", 0.0);
    m.centre = vector_or(node, "centre", Vec3::Zero()) - context.origin;
    if (node.has("axis")) m.axis = context.direction(node.at("axis"));
    m.start = number_or(node, "start", 0.0);
    m.end = number_or(node, "end", kForever);
    if (!m.amplitude.isZero(0.0) && m.frequency == 0.0) {
        context.error(node.at("amplitude"), "an oscillation needs a `frequency` other than 0");
    }
    if (m.amplitude.isZero(0.0) && m.frequency != 0.0) {
        context.error(node.at("frequency"), "an oscillation needs an `amplitude` other than 0");
    }
    context.check_ascending(node, "start", "end");
    return m;
}

}  // namespace

void build_walls(const Node& scenario, const Context& context, std::vector<TerrainFile> terrains, Scene& scene) {
    auto terrain = terrains.begin();
    const Node::List& list = items_of(scenario, "walls");
    context.check_unique_names(list, "wall");
    for (const Node& node : list) {
        Wall wall;
        wall.name = node.text("name");
        wall.material = context.material(node.at("material"));
        const bool is_terrain = node.text("shape") == "terrain";
        wall.shape = is_terrain ? build_terrain(node, std::move(*terrain++), context) : build_shape(node, context);
        wall.appears = number_or(node, "appears", 0.0);
        wall.goes = number_or(node, "goes", kForever);
        context.check_ascending(node, "appears", "goes");
        if (node.has("motion") && !is_terrain) wall.motion = build_motion(node.at("motion"), context);
        scene.walls.push_back(wall);
    }
}

void check_walls_of_polyhedra(const io::Node& scenario, const Scene& scene, const Context& context) {
    const io::Node::List& items = items_of(scenario, "walls");
    for (std::size_t w = 0; w < scene.walls.size(); ++w)
        if (contact::polyhedron_wall_cover(scene.walls[w].shape) == contact::WallCover::none)
            context.error(items[w],
                          "polyhedra do not feel this wall; expected a plane, a box, a cylinder or cone with "
                          "bodies inside, a disc or terrain");
}

}  // namespace scree::scenarios
