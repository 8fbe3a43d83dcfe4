#include "scenarios/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/named_shapes.hpp"
#include "scenarios/regions.hpp"
#include "scenarios/shapes/solids.hpp"

namespace scree::scenarios {
namespace {

constexpr std::size_t kSizeClasses = 20;
constexpr double kUnitTolerance = 1e-3;  // of a quaternion's length; text may have few digits

Quat quaternion(const io::Node& node, const Context& context) {
    const Quat q(node.at(0).number(), node.at(1).number(), node.at(2).number(), node.at(3).number());
    const double length = q.coeffs().stableNorm();
    if (std::abs(length - 1.0) <= kUnitTolerance) return q.normalized();
    context.error(node, fmt::format("is no unit quaternion [w, x, y, z]: its length is {:g}", length));
    return Quat::Identity();
}

Quat about(const Vec3& axis, double angle) {
    return Quat(Eigen::AngleAxisd(angle, axis));
}

// Uniform over all orientations (Shoemake 1992, Graphics Gems III, 124).
Quat random_orientation(Random& random) {
    const double share = random.uniform();
    const double a = 2.0 * std::numbers::pi * random.uniform(), b = 2.0 * std::numbers::pi * random.uniform();
    const double s = std::sqrt(1.0 - share), c = std::sqrt(share);
    return Quat(c * std::cos(b), s * std::sin(a), s * std::cos(a), c * std::sin(b)).normalized();
}

}  // namespace

Orientations::Orientations(const io::Node& node, const Context& context) {
    if (node.has("axis")) {
        if (!node.has("angle")) context.error(node.at("axis"), "needs an `angle`");
        fixed_ = about(context.direction(node.at("axis")), number_or(node, "angle", 0.0));
    } else if (node.has("angle")) {
        context.error(node.at("angle"), "is the angle about an `axis`, which is not given");
    } else if (node.has("quaternion")) {
        fixed_ = quaternion(node.at("quaternion"), context);
    } else if (node.has("euler")) {
        const Vec3 angle = node.vector("euler");
        fixed_ = (about(Vec3::UnitZ(), angle.z()) * about(Vec3::UnitY(), angle.y()) * about(Vec3::UnitX(), angle.x()))
                     .normalized();
    } else {
        random_ = node.boolean("random");
    }
}

Quat Orientations::draw(Random& random) const {
    return random_ ? random_orientation(random) : fixed_;
}

Random look_of(std::uint64_t seed, std::uint64_t stream, std::uint64_t k) {
    constexpr std::uint64_t kLooks = std::uint64_t{1} << 62;  // no generator's number is so large
    return {seed, stream | kLooks, k};
}

ShapeIndex BodyList::add_instance(const NamedShape& named, std::size_t variant, double factor) {
    const auto [at, is_new] = instances_.try_emplace({named.name, variant, factor}, kSphere);
    if (is_new) at->second = add_shape(scree::scaled(named.variants[variant].shape, factor), named.name);
    return at->second;
}

std::optional<Figures> Figures::read(const io::Node& node, std::uint64_t stream, const Context& context,
                                     BodyList& bodies) {
    const std::size_t before = context.errors();
    Figures figures;
    figures.seed_ = context.seed;
    figures.stream_ = stream;
    if (node.has("size")) figures.size_ = build_size(node.at("size"), context);
    if (node.has("shape")) {
        figures.named_ = &context.shapes[context.shape(node.at("shape"))];
        if (node.has("orientation")) figures.orientations_ = Orientations(node.at("orientation"), context);
    } else {
        for (const char* key : {"orientation", "size_classes"})
            if (node.has(key)) context.error(node.at(key), "needs a `shape`: these are spheres");
    }
    if (context.errors() != before) return std::nullopt;
    if (figures.named_ == nullptr) return figures;

    const bool one_size = !figures.size_ || smallest_diameter(*figures.size_) == largest_diameter(*figures.size_);
    if (!one_size)
        figures.classes_ =
            node.has("size_classes") ? static_cast<std::size_t>(node.integer("size_classes")) : kSizeClasses;
    for (std::size_t v = 0; v < figures.named_->variants.size(); ++v) {
        const double own = equivalent_diameter(figures.named_->variants[v].shape);
        for (std::size_t c = 0; c < figures.classes_; ++c) {
            double factor = 1.0;
            if (figures.size_) {
                const double least = smallest_diameter(*figures.size_), most = largest_diameter(*figures.size_);
                const double share = (static_cast<double>(c) + 0.5) / static_cast<double>(figures.classes_);
                factor = (one_size ? least : least * std::pow(most / least, share)) / own;
            }
            const ShapeIndex shape = bodies.add_instance(*figures.named_, v, factor);
            const ConvexShape& made = bodies.shapes[raw(shape)];
            figures.instances_.push_back({shape, made.radius, made.volume});
        }
    }
    // a shape that was found faulty: its error is reported, and no body is made
    if (figures.instances_.empty()) return std::nullopt;
    return figures;
}

std::size_t Figures::size_class(double diameter) const {
    if (classes_ == 1) return 0;
    const double least = smallest_diameter(*size_), most = largest_diameter(*size_);
    const double share = std::log(diameter / least) / std::log(most / least);
    const double place = std::floor(share * static_cast<double>(classes_));
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(classes_ - 1)));
}

Figure Figures::draw(std::uint64_t k, Random& random) const {
    const double diameter = size_ ? draw_diameter(*size_, random) : 0.0;
    if (named_ == nullptr) return {0.5 * diameter, Bodies::sphere_mass(0.5 * diameter, 1.0)};
    Random look = look_of(seed_, stream_, k);
    const std::size_t variant = named_->draw_variant(look);
    const Instance& instance = instances_[variant * classes_ + size_class(diameter)];
    return {instance.radius, instance.volume, instance.shape,
            (orientations_.draw(look) * named_->variants[variant].rotation).normalized()};
}

double Figures::largest_volume() const {
    if (named_ == nullptr) return ball_volume(largest_diameter(*size_));
    double largest = 0.0;
    for (const Instance& instance : instances_) largest = std::max(largest, instance.volume);
    return largest;
}

double Figures::largest_radius() const {
    if (named_ == nullptr) return 0.5 * largest_diameter(*size_);
    double largest = 0.0;
    for (const Instance& instance : instances_) largest = std::max(largest, instance.radius);
    return largest;
}

void add(BodyList& bodies, std::uint64_t id, const Figure& figure, MaterialIndex material, const Vec3& position,
         const Vec3& velocity, const Vec3& spin) {
    if (figure.shape == kSphere) {
        bodies.add(id, figure.radius, material, position, velocity, spin);
    } else {
        bodies.add(id, figure.shape, material, position, figure.orientation, velocity, spin);
    }
}

void generate_polyhedron(const io::Node& node, std::uint64_t stream, const Context& context, const Communicator& ranks,
                         BodyList& bodies) {
    const std::size_t before = context.errors();
    const MaterialIndex material = context.material(node.at("material"));
    const NamedShape& named = context.shapes[context.shape(node.at("shape"))];
    Orientations orientations;
    if (node.has("orientation")) orientations = Orientations(node.at("orientation"), context);
    if (context.errors() != before || named.variants.empty()) return;

    Random look = look_of(context.seed, stream, 0);
    const std::size_t variant = named.draw_variant(look);
    const PlacedShape& placed = named.variants[variant];
    const double factor = node.has("diameter") ? node.number("diameter") / equivalent_diameter(placed.shape)
                                               : number_or(node, "scale", 1.0);
    const ShapeIndex shape = bodies.add_instance(named, variant, factor);
    const std::uint64_t id = bodies.next_id++;
    if (id % static_cast<std::uint64_t>(ranks.size()) != static_cast<std::uint64_t>(ranks.rank())) return;
    const Quat turned = orientations.draw(look);
    Vec3 position = context.point(node.at("position"));
    if (node.text("placed_by") == "origin") position += turned * (factor * placed.centre);
    bodies.add(id, shape, material, position, (turned * placed.rotation).normalized(),
               vector_or(node, "velocity", Vec3::Zero()), vector_or(node, "spin", Vec3::Zero()));
}

}  // namespace scree::scenarios
