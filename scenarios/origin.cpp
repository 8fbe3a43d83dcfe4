#include "scenarios/origin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree::scenarios {
namespace {

using Node = io::Node;

struct Box {
    Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 upper = Vec3::Constant(-std::numeric_limits<double>::infinity());

    void add(const Vec3& x, double radius = 0.0) {
        lower = lower.cwiseMin(x - Vec3::Constant(radius));
        upper = upper.cwiseMax(x + Vec3::Constant(radius));
    }
    bool empty() const { return !(lower.array() <= upper.array()).all(); }
};

// Points along an axis from `base`; both ends count, an infinite one has only its base.
void add_axial(Box& box, const Node& node, double radius) {
    const Vec3 base = node.vector("base");
    box.add(base, radius);
    if (!node.has("length")) return;
    const Vec3 axis = node.has("axis") ? node.vector("axis") : Vec3(Vec3::UnitZ());
    box.add(base + node.number("length") * axis.stableNormalized(), radius);
}

void add_region(Box& box, const Node& node) {
    const std::string& shape = node.text("shape");
    if (shape == "box") {
        box.add(node.vector("lower"));
        box.add(node.vector("upper"));
    } else if (shape == "cylinder") {
        add_axial(box, node, node.number("radius"));
    } else if (shape == "sphere") {
        box.add(node.vector("centre"), node.number("radius"));
    }
}

void add_lattice(Box& box, const Node& node) {
    const Vec3 corner = node.vector("corner"), pitch = node.vector("pitch");
    Vec3 cells;
    for (int i = 0; i < 3; ++i) cells[i] = node.at("cells").at(static_cast<std::size_t>(i)).number();
    // `count` may end long before the last layer
    if (node.has("count")) cells.z() = std::min(cells.z(), std::ceil(node.number("count") / (cells.x() * cells.y())));
    box.add(corner, 0.5 * pitch.maxCoeff());
    box.add(corner + cells.cwiseProduct(pitch), 0.5 * pitch.maxCoeff());
}

void add_bodies(Box& box, const Node& node) {
    const std::string& generator = node.text("generator");
    if (generator == "sphere") {
        box.add(node.vector("position"), node.has("radius") ? node.number("radius") : 0.5 * node.number("diameter"));
    } else if (generator == "lattice") {
        add_lattice(box, node);
    } else if (generator == "random") {
        add_region(box, node.at("region"));
    }
}

void add_wall(Box& box, const Node& node) {
    const std::string& shape = node.text("shape");
    if (shape == "box") {
        box.add(node.vector("lower"));
        box.add(node.vector("upper"));
    } else if (shape == "cylinder") {
        add_axial(box, node, node.number("radius"));
    } else if (shape == "cone") {
        add_axial(box, node, std::max(node.number("radius_base"), node.number("radius_end")));
    } else if (shape == "disc") {
        box.add(node.vector("centre"), node.number("radius"));
    } else if (shape == "orifice_floor") {
        box.add(node.vector("centre"), 0.5 * node.number("hole_diameter"));
    } else if (shape == "slot_floor") {
        box.add(node.vector("centre"), 0.5 * node.number("width"));
    }
}

}  // namespace

Vec3 choose_origin(const Node& scenario, const std::vector<BodyFile>& files, const std::vector<TerrainFile>& terrains) {
    Box box;
    for (const Node& node : items_of(scenario, "bodies")) add_bodies(box, node);
    for (const Node& node : items_of(scenario, "inlets")) add_region(box, node.at("region"));
    for (const Node& node : items_of(scenario, "walls")) add_wall(box, node);
    for (const BodyFile& file : files) {
        if (file.bodies == 0) continue;
        box.add(file.lower);
        box.add(file.upper);
    }
    for (const TerrainFile& terrain : terrains) {
        if (terrain.empty()) continue;
        box.add(terrain.lower);
        box.add(terrain.upper);
    }
    if (box.empty()) return Vec3::Zero();

    const double extent = (box.upper - box.lower).maxCoeff();
    const double farthest = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    if (!(farthest > (terrains.empty() ? 1000.0 : 1.0) * extent) || !std::isfinite(farthest)) return Vec3::Zero();
    int exponent = 0;
    std::frexp(extent, &exponent);
    const double unit = std::ldexp(1.0, exponent);  // extent < unit <= 2 extent
    const Vec3 middle = 0.5 * (box.lower + box.upper);
    return (middle / unit).array().round().matrix() * unit;
}

}  // namespace scree::scenarios
