// What the bodies of one generator look like: spheres of drawn sizes, or instances of a shape that the scenario names.
//
// Which variant body k has and how it is turned come from random numbers of their own: they change neither its size
// nor its place, which are those of a sphere of the same diameter.
#pragma once

#include <optional>

#include "core/size_distribution.hpp"
#include "scenarios/generators.hpp"

namespace scree::scenarios {

// A section ORIENTATION: one rotation for all, or one drawn for each.
class Orientations {
  public:
    Orientations() = default;
    Orientations(const io::Node& node, const Context& context);
    Quat draw(Random& random) const;

  private:
    Quat fixed_ = Quat::Identity();
    bool random_ = false;
};

struct Figure {
    double radius;  // [m] of the ball about the centre of mass that holds it
    double volume;  // [m3]
    ShapeIndex shape = kSphere;
    Quat orientation = Quat::Identity();  // of the body frame
};

class Figures {
  public:
    // From the keys `size`, `shape`, `size_classes` and `orientation`; nothing after an error. To be called alike on
    // all ranks: it adds to bodies.shapes what its bodies can be.
    static std::optional<Figures> read(const io::Node& node, std::uint64_t stream, const Context& context,
                                       BodyList& bodies);

    // Body k; `random` gives its size and then goes on.
    Figure draw(std::uint64_t k, Random& random) const;
    double largest_volume() const;
    double largest_radius() const;  // [m] of the balls that hold them

  private:
    std::size_t size_class(double diameter) const;
    Quat body_frame(std::size_t variant) const;

    std::optional<SizeDistribution> size_;
    std::uint64_t seed_ = 0, stream_ = 0;
    const NamedShape* named_ = nullptr;  // none: spheres
    Orientations orientations_;
    std::size_t classes_ = 1;
    struct Instance {
        ShapeIndex shape;
        double radius, volume;
    };
    std::vector<Instance> instances_;  // variant by variant, class by class
};

// The random numbers of how body k looks.
Random look_of(std::uint64_t seed, std::uint64_t stream, std::uint64_t k);

void add(BodyList& bodies, std::uint64_t id, const Figure& figure, MaterialIndex material, const Vec3& position,
         const Vec3& velocity, const Vec3& spin);

}  // namespace scree::scenarios
