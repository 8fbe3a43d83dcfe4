// Masonry: walls of equal blocks, arches of equal voussoirs.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "scenarios/placed_blocks.hpp"
#include "scenarios/shapes/solids.hpp"

namespace scree::scenarios {
namespace {

// Columns: along, to the left of it, up.
std::optional<Mat3> frame_of(const io::Node& node, const Context& context) {
    const Vec3 up = context.direction(node.at("up"));
    Vec3 along = context.direction(node.at("direction"));
    along -= along.dot(up) * up;
    if (along.norm() < 1e-9) {
        context.error(node.at("direction"), "must not be parallel to `up`");
        return std::nullopt;
    }
    Mat3 frame;
    frame.col(0) = along.normalized();
    frame.col(1) = up.cross(frame.col(0)).normalized();
    frame.col(2) = up;
    return frame;
}

// Instances of a few shapes, one after the other.
class Instances {
  public:
    Instances(const io::Node& node, const Context& context, const Communicator& ranks, std::uint64_t count,
              BodyList& bodies)
        : common_(node, context), part_(count, ranks), first_(bodies.next_id), bodies_(bodies) {
        bodies.next_id += count;
    }
    // Its own frame's origin at `x`, turned by `q`.
    void add(ShapeIndex shape, const PlacedShape& placed, const Vec3& x, const Quat& q) {
        if (part_.has(number_))
            bodies_.add(first_ + number_, shape, common_.material, x + q * placed.centre,
                        (q * placed.rotation).normalized(), common_.velocity, common_.spin);
        ++number_;
    }

  private:
    CommonState common_;
    Part part_;
    std::uint64_t first_, number_ = 0;
    BodyList& bodies_;
};

// Its joints at the angles -+half from z, in the middle of y.
Polyhedron voussoir(double half, double inner, double outer, double depth) {
    Polyhedron body;
    for (const double y : {-0.5 * depth, 0.5 * depth})
        for (const double r : {inner, outer})
            for (const double a : {-half, half}) body.vertex.emplace_back(r * std::sin(a), y, r * std::cos(a));
    // vertex 4 y + 2 r + a
    body.face = {{0, 1, 3, 2}, {5, 4, 6, 7}, {1, 0, 4, 5}, {2, 3, 7, 6}, {0, 2, 6, 4}, {3, 1, 5, 7}};
    return body;
}

}  // namespace

void generate_wall_of_blocks(const io::Node& node, const Context& context, const Communicator& ranks,
                             BodyList& bodies) {
    const auto frame = frame_of(node, context);
    const Vec3 size = node.vector("size");
    const double gap = node.number("gap");
    const bool running = node.text("bond") == "running";
    const auto rows = static_cast<std::uint64_t>(node.integer("rows"));
    const auto columns = static_cast<std::uint64_t>(node.integer("columns"));
    const std::uint64_t count = rows * columns + (running ? rows / 2 : 0);
    if (!(size.minCoeff() > 0.0)) {
        context.error(node.at("size"), "lengths must be above 0");
    } else if (running && rows > 1 && gap >= size.x()) {
        context.error(node.at("gap"), fmt::format("must be less than a block's length, {:g} m", size.x()));
    } else if (static_cast<double>(count) > kMostBodies) {
        context.error(node.at("rows"), fmt::format("{:g} blocks are more than one run can hold ({:g})",
                                                   static_cast<double>(count), kMostBodies));
    } else if (frame) {
        const std::string name = name_of_generator(node);
        const PlacedShape whole = box(size), half = box(Vec3(0.5 * (size.x() - gap), size.y(), size.z()));
        const ShapeIndex whole_index = bodies.add_shape(whole.shape, name);
        const ShapeIndex half_index = bodies.add_shape(half.shape, name);
        const Vec3 corner = context.point(node.at("corner"));
        const Quat q(*frame);
        Instances instances(node, context, ranks, count, bodies);
        for (std::uint64_t row = 0; row < rows; ++row) {
            const bool shifted = running && row % 2 == 1;
            const double up = static_cast<double>(row) * (size.z() + gap) + 0.5 * size.z();
            const auto add = [&](ShapeIndex shape, const PlacedShape& placed, double along) {
                instances.add(shape, placed, corner + *frame * Vec3(along, 0.5 * size.y(), up), q);
            };
            const double length = static_cast<double>(columns) * (size.x() + gap) - gap;
            const double half_length = 0.5 * (size.x() - gap), pitch = size.x() + gap;
            if (shifted) add(half_index, half, 0.5 * half_length);
            for (std::uint64_t k = 0; k < columns - (shifted ? 1 : 0); ++k)
                add(whole_index, whole,
                    static_cast<double>(k) * pitch + 0.5 * size.x() + (shifted ? half_length + gap : 0.0));
            if (shifted) add(half_index, half, length - 0.5 * half_length);
        }
    }
}

void generate_arch(const io::Node& node, const Context& context, const Communicator& ranks, BodyList& bodies) {
    const auto frame = frame_of(node, context);
    const double radius = node.number("radius"), thickness = node.number("thickness");
    const double embrace = node.number("embrace");
    const auto count = static_cast<std::uint64_t>(node.integer("count"));
    const double half = 0.5 * embrace / static_cast<double>(count);
    if (thickness >= 2.0 * radius) {
        context.error(node.at("thickness"), fmt::format("must be less than twice the radius, {:g} m", 2.0 * radius));
    } else if (half > 0.49 * std::numbers::pi) {
        context.error(node.at("count"), "is too small: one voussoir would span half a circle");
    } else if (frame) {
        const PlacedShape placed =
            make_shape(voussoir(half, radius - 0.5 * thickness, radius + 0.5 * thickness, node.number("depth")));
        const ShapeIndex shape = bodies.add_shape(placed.shape, name_of_generator(node));
        const Vec3 centre = context.point(node.at("centre"));
        Instances instances(node, context, ranks, count, bodies);
        for (std::uint64_t k = 0; k < count; ++k) {
            const double angle = half * (2.0 * static_cast<double>(k) + 1.0) - 0.5 * embrace;
            instances.add(shape, placed, centre, Quat(*frame) * Quat(Eigen::AngleAxisd(angle, Vec3::UnitY())));
        }
    }
}

}  // namespace scree::scenarios
