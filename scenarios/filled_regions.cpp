// Parts of space filled with blocks: the Voronoi cells of random points, and rock between joints.
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "scenarios/named_shapes.hpp"
#include "scenarios/placed_blocks.hpp"
#include "scenarios/regions.hpp"
#include "scenarios/shapes/convex_hull.hpp"
#include "scenarios/shapes/rock_mass.hpp"
#include "scenarios/shapes/solids.hpp"
#include "scenarios/shapes/voronoi.hpp"

namespace scree::scenarios {
namespace {

constexpr double kMostBlocks = 1e7;

struct Counted {
    std::vector<PlacedShape> blocks;
    std::size_t gone = 0;  // too thin to be bodies
};

// Shrunk by half of the gap on every face.
Counted shrunk(std::vector<PlacedShape> blocks, double gap) {
    if (gap == 0.0) return {std::move(blocks), 0};
    Counted result;
    for (const PlacedShape& block : blocks) {
        const Polyhedron left = eroded(block, 0.5 * gap);
        try {
            if (left.face.empty()) {
                ++result.gone;
            } else {
                result.blocks.push_back(make_shape(left));
            }
        } catch (const ShapeError& error) {
            if (error.fault() != ShapeFault::no_volume) throw;
            ++result.gone;
        }
    }
    return result;
}

std::vector<PlacedShape> cells_of(const Polyhedron& body, std::size_t count, std::uint64_t stream,
                                  const Context& context) {
    const Extent extent = extent_of(body.vertex);
    std::vector<Vec3> seeds(count);
    for (std::size_t k = 0; k < count; ++k) {
        Random random(context.seed, stream, k);
        for (int i = 0; i < 3; ++i) seeds[k][i] = random.uniform(extent.lower[i], extent.upper[i]);
    }
    std::vector<PlacedShape> cells;
    for (const Polyhedron& cell : voronoi_cells(body, seeds)) cells.push_back(make_shape(cell));
    return cells;
}

// Takes those smaller than `smallest` out; returns their volume [m3].
double leave_out(std::vector<PlacedShape>& blocks, double smallest) {
    double volume = 0.0;
    std::erase_if(blocks, [&](const PlacedShape& block) {
        const bool small = equivalent_diameter(block.shape) < smallest;
        if (small) volume += block.shape.volume;
        return small;
    });
    return volume;
}

void add_shrunk(const io::Node& node, const Context& context, const Communicator& ranks,
                std::vector<PlacedShape> blocks, BodyList& bodies) {
    const double gap = node.number("gap");
    Counted left = shrunk(std::move(blocks), gap);
    if (left.blocks.empty()) {
        context.error(node.at("gap"), fmt::format("leaves nothing of {} blocks", left.gone));
        return;
    }
    if (left.gone != 0)
        context.warning(node.at("gap"),
                        fmt::format("is more than the thickness of {} blocks; they are left out", left.gone));
    const std::size_t before = left.blocks.size();
    const double volume = leave_out(left.blocks, node.number("smallest"));
    const std::size_t small = before - left.blocks.size();
    if (small == before) {
        context.error(node.at("smallest"), fmt::format("is more than the size of all {} blocks", before));
        return;
    }
    if (small != 0)
        context.warning(node.at("smallest"),
                        fmt::format("leaves out {} of {} blocks, {:.3g} m3", small, before, volume));
    add_blocks(node, context, ranks, std::move(left.blocks), bodies);
}

// Faults of shapes are reported at the generator.
void reporting(const io::Node& node, const Context& context, const std::function<void()>& work) {
    try {
        work();
    } catch (const ShapeError& error) {
        context.error(node, error.what());
    }
}

Polyhedron hull_of(const io::Node& points, const Context& context) {
    std::vector<Vec3> local;
    for (const io::Node& row : points.items())
        local.push_back(Vec3(row.at(0).number(), row.at(1).number(), row.at(2).number()) - context.origin);
    return polyhedron_of(convex_hull(local));
}

std::vector<JointSet> joint_sets(const io::Node& node) {
    std::vector<JointSet> sets;
    for (const io::Node& joint : items_of(node, "joints"))
        sets.push_back({joint.number("dip"), joint.number("dip_direction"), joint.number("spacing"),
                        joint.number("spacing_scatter"), joint.number("angle_scatter")});
    return sets;
}

}  // namespace

void generate_voronoi(const io::Node& node, std::uint64_t stream, const Context& context, const Communicator& ranks,
                      BodyList& bodies) {
    const auto region = build_finite_region(node.at("region"), context);
    if (!region) return;
    const auto& sides = std::get<BoxRegion>(*region);
    double count = 0.0;
    if (node.has("count")) {
        count = node.number("count");
    } else {
        count = std::max(1.0, std::round(volume(*region) / ball_volume(node.number("cell_size"))));
        if (count > kMostBlocks) {
            context.error(node.at("cell_size"), fmt::format("makes {:g} cells, more than {:g}", count, kMostBlocks));
            return;
        }
    }
    reporting(node, context, [&] {
        add_shrunk(node, context, ranks,
                   cells_of(box_between(sides.lower, sides.upper), static_cast<std::size_t>(count), stream, context),
                   bodies);
    });
}

void generate_rock_mass(const io::Node& node, std::uint64_t stream, const Context& context, const Communicator& ranks,
                        BodyList& bodies) {
    reporting(node, context, [&] {
        Polyhedron body;
        if (node.has("region")) {
            const auto region = build_finite_region(node.at("region"), context);
            if (!region) return;
            body = box_between(std::get<BoxRegion>(*region).lower, std::get<BoxRegion>(*region).upper);
        } else {
            body = hull_of(node.at("points"), context);
        }
        RockMass mass = cut_rock_mass(body, joint_sets(node), mix64(mix64(context.seed) ^ stream),
                                      static_cast<std::size_t>(kMostBlocks));
        if (mass.slivers != 0)
            context.warning(node, fmt::format("{} slivers of {:.3g} m3 in all are too thin to be bodies; they are left "
                                              "out",
                                              mass.slivers, mass.lost));
        add_shrunk(node, context, ranks, std::move(mass.blocks), bodies);
    });
}

}  // namespace scree::scenarios
