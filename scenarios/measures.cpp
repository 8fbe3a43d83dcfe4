#include "scenarios/measures.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "core/errors.hpp"
#include "scenarios/regions.hpp"

namespace scree::scenarios {
namespace {

constexpr std::array<std::pair<std::string_view, MeasureKind>, 7> kKinds = {{
    {"flow_rate", MeasureKind::flow_rate},
    {"mass_in", MeasureKind::mass_in},
    {"wall_force", MeasureKind::wall_force},
    {"coordination", MeasureKind::coordination},
    {"packing_fraction", MeasureKind::packing_fraction},
    {"profile", MeasureKind::profile},
    {"extent", MeasureKind::extent},
}};

MeasureKind kind_of(const io::Node& node) {
    for (const auto& [name, kind] : kKinds) {
        if (node.text("measure") == name) return kind;
    }
    throw InternalError(fmt::format("the measure '{}' is in the schema, but cannot be built", node.text("measure")));
}

Measure build_measure(const io::Node& node, const std::vector<std::string>& walls, const Context& context,
                      const Scene& scene) {
    Measure m;
    m.name = node.text("name");
    m.kind = kind_of(node);
    m.from = number_or(node, "from", 0.0);
    m.until = number_or(node, "until", scene.time.end);
    if (!(m.from < m.until)) {
        const bool given = node.has("until");
        context.error(node.at(given ? "until" : "from"), fmt::format("the window from {:g} s until {:g} s{} is empty",
                                                                     m.from, m.until, given ? "" : " (time.end)"));
    }
    if (node.has("region")) {
        const bool needs_volume = m.kind == MeasureKind::packing_fraction;
        m.region =
            needs_volume ? build_finite_region(node.at("region"), context) : build_region(node.at("region"), context);
    }
    if (node.has("axis")) m.axis = context.direction(node.at("axis"));
    if (m.kind == MeasureKind::flow_rate) {
        m.surface.point = context.point(node.at("point"));
        m.surface.normal = context.direction(node.at("normal"));
        if (node.has("radius")) m.surface.radius = node.number("radius");
    }
    if (m.kind == MeasureKind::wall_force) {
        m.wall = WallIndex{static_cast<std::uint32_t>(context.find(node.at("wall"), walls, "wall"))};
    }
    if (m.kind == MeasureKind::profile) {
        context.check_ascending(node, "lower", "upper");
        const double shift = context.origin.dot(m.axis);
        m.from_coordinate = node.number("lower") - shift;
        m.to_coordinate = node.number("upper") - shift;
        m.bins = static_cast<int>(node.integer("bins"));
    }
    return m;
}

}  // namespace

void build_measures(const io::Node& scenario, const Context& context, Scene& scene) {
    const io::Node::List& list = items_of(scenario, "measures");
    context.check_unique_names(list, "measure");
    std::vector<std::string> walls;
    for (const Wall& wall : scene.walls) walls.push_back(wall.name);
    for (const io::Node& node : list) scene.measures.push_back(build_measure(node, walls, context, scene));
}

void check_measures_of_polyhedra(const io::Node& scenario, const Context& context) {
    for (const io::Node& node : items_of(scenario, "measures")) {
        const std::string& kind = node.text("measure");
        if ((kind != "packing_fraction" && kind != "profile") || !node.has("region")) continue;
        const io::Node& shape = node.at("region").at("shape");
        const bool profile_by_centres = kind == "profile" && shape.text() == "sphere";
        if (shape.text() == "box" || shape.text() == "half_space" || profile_by_centres) continue;
        context.error(shape, fmt::format("the volume of polyhedra is measured in regions with flat sides, not in a {}: "
                                         "use a box",
                                         shape.text()));
    }
}

}  // namespace scree::scenarios
