#include "scenarios/regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace scree::scenarios {
namespace {

std::optional<Region> build_box(const io::Node& node, const Context& context) {
    const BoxRegion box{context.point(node.at("lower")), context.point(node.at("upper"))};
    for (int i = 0; i < 3; ++i) {
        if (box.lower[i] < box.upper[i]) continue;
        context.error(node.at("upper"),
                      fmt::format("must be more than lower on every axis; on {} it is {:g}, lower {:g}", "xyz"[i],
                                  node.vector("upper")[i], node.vector("lower")[i]));
        return std::nullopt;
    }
    return box;
}

SizeDistribution build_normal(const io::Node& node, const Context& context) {
    const double mean = node.number("mean"), deviation = node.number("deviation");
    const double lower = number_or(node, "lower", std::max(mean - 3.0 * deviation, 0.1 * mean));
    const double upper = number_or(node, "upper", mean + 3.0 * deviation);
    if (!(lower < upper)) context.error(node, fmt::format("lower ({:g}) must be less than upper ({:g})", lower, upper));
    return NormalSize{mean, deviation, lower, upper};
}

SizeDistribution build_log_normal(const io::Node& node, const Context& context) {
    const double median = node.number("median"), sigma = node.number("sigma");
    const double lower = number_or(node, "lower", median * std::exp(-3.0 * sigma));
    const double upper = number_or(node, "upper", median * std::exp(3.0 * sigma));
    if (!(lower < upper)) context.error(node, fmt::format("lower ({:g}) must be less than upper ({:g})", lower, upper));
    return LogNormalSize{median, sigma, lower, upper};
}

SizeDistribution build_table(const io::Node& node, const Context& context) {
    TableSize table;
    const io::Node& rows = node.at("rows");
    for (const io::Node& row : rows.items()) {
        table.diameter.push_back(row.at(0).number());
        table.passing.push_back(row.at(1).number());
        if (!(table.diameter.back() > 0.0)) context.error(row, "a diameter must be above 0");
        const std::size_t n = table.diameter.size();
        if (n < 2) continue;
        if (!(table.diameter[n - 2] < table.diameter[n - 1]))
            context.error(row, "diameters must increase from row to row");
        if (!(table.passing[n - 2] <= table.passing[n - 1]))
            context.error(row, "the share must not fall from row to row");
    }
    if (table.diameter.empty()) {
        context.error(rows, "needs at least one row [diameter, share]");
        return FixedSize{1.0};
    }
    if (table.passing.front() < 0.0 || table.passing.back() != 1.0) {
        context.error(rows.items().back(),
                      fmt::format("the cumulative share runs from 0 up to 1; it ends at {:g}", table.passing.back()));
    }
    return table;
}

}  // namespace

std::optional<Region> build_region(const io::Node& node, const Context& context) {
    const std::string& shape = node.text("shape");
    const std::size_t before = context.errors();
    std::optional<Region> region;
    if (shape == "box") {
        region = build_box(node, context);
    } else if (shape == "cylinder") {
        region = CylinderRegion{context.point(node.at("base")),
                                node.has("axis") ? context.direction(node.at("axis")) : Vec3::UnitZ(),
                                node.number("radius"), node.number("length")};
    } else if (shape == "sphere") {
        region = SphereRegion{context.point(node.at("centre")), node.number("radius")};
    } else {
        SCREE_CHECK(shape == "half_space");
        region = HalfSpaceRegion{context.point(node.at("point")), context.direction(node.at("normal"))};
    }
    return context.errors() == before ? region : std::nullopt;
}

std::optional<Region> build_finite_region(const io::Node& node, const Context& context) {
    std::optional<Region> region = build_region(node, context);
    if (region && std::holds_alternative<HalfSpaceRegion>(*region)) {
        context.error(node, "a half_space has no end; this needs a box, a cylinder or a sphere");
        return std::nullopt;
    }
    return region;
}

std::optional<SizeDistribution> build_size(const io::Node& node, const Context& context) {
    const std::string& kind = node.text("distribution");
    const std::size_t before = context.errors();
    SizeDistribution size = FixedSize{0.0};
    if (kind == "fixed") {
        size = FixedSize{node.number("diameter")};
    } else if (kind == "uniform") {
        context.check_ascending(node, "lower", "upper");
        size = UniformSize{node.number("lower"), node.number("upper")};
    } else if (kind == "normal") {
        size = build_normal(node, context);
    } else if (kind == "log_normal") {
        size = build_log_normal(node, context);
    } else if (kind == "power_law") {
        context.check_ascending(node, "lower", "upper");
        size = PowerLawSize{node.number("lower"), node.number("upper"), node.number("exponent")};
    } else {
        SCREE_CHECK(kind == "table");
        size = build_table(node, context);
    }
    return context.errors() == before ? std::optional(size) : std::nullopt;
}

}  // namespace scree::scenarios
