#include "scenarios/named_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "contact/polyhedra/manifold.hpp"
#include "core/errors.hpp"
#include "scenarios/shapes/convex_hull.hpp"
#include "scenarios/shapes/mesh_file.hpp"
#include "scenarios/shapes/rock.hpp"
#include "scenarios/shapes/solids.hpp"
#include "scenarios/shared_text.hpp"

namespace scree::scenarios {
namespace {

using Node = io::Node;

constexpr double kLongShown = 20.0;  // a needle's length over its breadth, a plate's breadth over its thickness
constexpr double kEdgeShown = 1e-5;  // of the length

// To the diameter of the ball of equal volume, or the volume, that the node gives; else as it is.
PlacedShape sized(PlacedShape placed, const Node& node) {
    if (node.has("diameter")) return with_volume(std::move(placed), ball_volume(node.number("diameter")));
    if (node.has("volume")) return with_volume(std::move(placed), node.number("volume"));
    return placed;
}

PlacedShape regular_solid(const Node& node, Platonic solid) {
    return sized(platonic(solid, number_or(node, "edge", 1.0)), node);
}

PlacedShape eota(const Node& node) {
    const std::string& form = node.text("form");
    const Vec3 sides = form == "EOTA111"   ? Vec3(1.0, 1.0, 1.0)
                       : form == "EOTA211" ? Vec3(1.0, 0.5, 0.5)
                                           : Vec3(1.0, 1.0, 0.5);
    return sized(eota_block(number_or(node, "length", 1.0) * sides), node);
}

// FNV-1a: rocks depend on the seed and their name, not on what else is in the list.
std::uint64_t hash_of(const std::string& name) {
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    return hash;
}

std::vector<PlacedShape> rocks(const Node& node, std::uint64_t seed) {
    const RockForm form{static_cast<int>(node.integer("points")), node.number("elongation"), node.number("flatness")};
    std::vector<PlacedShape> variants;
    for (std::int64_t v = 0; v < node.integer("variants"); ++v) {
        const Random random(mix64(seed), hash_of(node.text("name")), static_cast<std::uint64_t>(v));
        variants.push_back(sized(scaled(random_rock(form, random), number_or(node, "length", 1.0)), node));
    }
    return variants;
}

PlacedShape hull_of(const Node& node) {
    std::vector<Vec3> points;
    for (const Node& row : node.at("points").items())
        points.emplace_back(row.at(0).number(), row.at(1).number(), row.at(2).number());
    return sized(scaled(convex_hull(points), number_or(node, "scale", 1.0)), node);
}

std::string shared_bytes(const std::string& path, const Communicator& ranks) {
    SharedText text(path, ranks);
    if (!text.is_file()) throw IoError(fmt::format("{}: cannot be opened for reading", path));
    std::string bytes;
    for (std::string piece = text.next(); !piece.empty(); piece = text.next()) bytes += piece;
    if (text.failed()) throw IoError(fmt::format("{}: cannot be read to its end", path));
    return bytes;
}

PlacedShape mesh(const Node& node, const Context& context, const Communicator& ranks) {
    const std::string path = (std::filesystem::path(context.folder) / node.text("path")).lexically_normal().string();
    return sized(
        read_mesh_bytes(path, shared_bytes(path, ranks), {number_or(node, "scale", 1.0), node.boolean("hull")}), node);
}

std::vector<PlacedShape> variants_of(const Node& node, const Context& context, const Communicator& ranks) {
    const std::string& kind = node.text("kind");
    if (kind == "box") return {sized(box(node.vector("size")), node)};
    if (kind == "prism") {
        const PlacedShape placed =
            prism(static_cast<int>(node.integer("sides")), 2.0 * node.number("radius"), node.number("height"));
        return {sized(placed, node)};
    }
    if (kind == "tetrahedron") return {regular_solid(node, Platonic::tetrahedron)};
    if (kind == "octahedron") return {regular_solid(node, Platonic::octahedron)};
    if (kind == "dodecahedron") return {regular_solid(node, Platonic::dodecahedron)};
    if (kind == "icosahedron") return {regular_solid(node, Platonic::icosahedron)};
    if (kind == "eota") return {eota(node)};
    if (kind == "rock") return rocks(node, context.seed);
    if (kind == "hull") return {hull_of(node)};
    SCREE_CHECK(kind == "file");
    return {mesh(node, context, ranks)};
}

double shortest_edge(const ConvexShape& shape) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const ConvexShape::Edge& e : shape.edge)
        shortest = std::min(shortest, (shape.vertex[e.from] - shape.vertex[e.to]).norm());
    return shortest;
}

}  // namespace

PlacedShape scaled(PlacedShape placed, double factor) {
    placed.shape = scree::scaled(std::move(placed.shape), factor);
    placed.centre *= factor;
    return placed;
}

double equivalent_diameter(const ConvexShape& shape) {
    return std::cbrt(6.0 * shape.volume / std::numbers::pi);
}

void check_features(const ConvexShape& shape) {
    const std::size_t most = std::max(shape.edge.size(), std::max(shape.vertex.size(), shape.face.size()));
    if (most >= contact::kMostFeatures)
        throw ShapeError(ShapeFault::bad_face,
                         fmt::format("has {} edges, faces or vertices, more than a contact can name ({})", most,
                                     contact::kMostFeatures - 1));
}

std::string trouble_with(const ConvexShape& shape) {
    const Extent extent = extent_of(shape.vertex);  // along the principal axes
    const Vec3 sides = extent.upper - extent.lower;
    std::array<double, 3> side{sides.x(), sides.y(), sides.z()};
    std::sort(side.begin(), side.end());
    if (side[2] > kLongShown * side[1])
        return fmt::format(
            "is a needle, {:.3g} times as long as wide: it needs a step in which its ends move less "
            "than its width",
            side[2] / side[1]);
    if (side[1] > kLongShown * side[0])
        return fmt::format(
            "is a plate, {:.3g} times as wide as thick: it needs a step in which its rim moves less "
            "than its thickness",
            side[1] / side[0]);
    const double edge = shortest_edge(shape) / side[2];
    if (edge < kEdgeShown)
        return fmt::format(
            "has an edge of {:.2g} of its length, whose ends act as one point of contact and cost as two", edge);
    return {};
}

void build_shapes(const Node& scenario, const Communicator& ranks, Context& context) {
    for (const Node& node : items_of(scenario, "shapes")) {
        NamedShape named{node.text("name"), {}};
        try {
            named.variants = variants_of(node, context, ranks);
            for (const PlacedShape& placed : named.variants) {
                check_features(placed.shape);
                const std::string trouble = trouble_with(placed.shape);
                if (trouble.empty()) continue;
                context.warning(node, fmt::format("shape '{}' {}", named.name, trouble));
                break;
            }
        } catch (const ShapeError& error) {
            context.error(node, fmt::format("shape '{}': {}", named.name, error.what()));
        } catch (const IoError& error) {
            context.error(node.at("path"), error.what());
        }
        context.shapes.push_back(std::move(named));
    }
}

}  // namespace scree::scenarios
