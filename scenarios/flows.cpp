#include "scenarios/flows.hpp"

#include <fmt/format.h>

#include "scenarios/regions.hpp"

namespace scree::scenarios {

void build_inlets(const io::Node& scenario, const Context& context, Scene& scene) {
    const io::Node::List& list = items_of(scenario, "inlets");
    context.check_unique_names(list, "inlet");
    for (const io::Node& node : list) {
        Inlet inlet;
        inlet.name = node.text("name");
        inlet.material = context.material(node.at("material"));
        const auto size = build_size(node.at("size"), context);
        const auto region = build_finite_region(node.at("region"), context);
        if (size) inlet.size = *size;
        if (region && !std::holds_alternative<BoxRegion>(*region)) {
            context.error(node.at("region"), "an inlet's region is a box");
        } else if (region) {
            inlet.region = std::get<BoxRegion>(*region);
            const double narrowest = (inlet.region.upper - inlet.region.lower).minCoeff();
            if (size && largest_diameter(*size) > narrowest) {
                context.error(node.at("region"),
                              fmt::format("is {:g} m narrow: the largest body ({:g} m) does not fit in", narrowest,
                                          largest_diameter(*size)));
            }
        }
        inlet.mass_rate = node.number("mass_rate");
        inlet.velocity = vector_or(node, "velocity", Vec3::Zero());
        inlet.from = number_or(node, "from", 0.0);
        inlet.until = number_or(node, "until", kForever);
        inlet.max_mass = number_or(node, "max_mass", kForever);
        context.check_ascending(node, "from", "until");
        scene.inlets.push_back(inlet);
    }
}

void build_outlets(const io::Node& scenario, const Context& context, Scene& scene) {
    const io::Node::List& list = items_of(scenario, "outlets");
    context.check_unique_names(list, "outlet");
    for (const io::Node& node : list) {
        const auto region = build_region(node.at("region"), context);
        Outlet outlet;
        outlet.name = node.text("name");
        if (region) outlet.region = *region;
        outlet.from = number_or(node, "from", 0.0);
        outlet.until = number_or(node, "until", kForever);
        context.check_ascending(node, "from", "until");
        scene.outlets.push_back(outlet);
    }
}

}  // namespace scree::scenarios
