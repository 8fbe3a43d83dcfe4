#include "scenarios/shapes/rock_mass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "core/volume_integrals.hpp"
#include "scenarios/shapes/cut.hpp"

namespace scree::scenarios {
namespace {

constexpr double kThinnest = 1e-9;  // of the size of the mass

void check_set(const JointSet& set, std::size_t number) {
    const auto fail = [number](const char* what, double value, const char* expected) {
        throw ShapeError(ShapeFault::no_volume, fmt::format("joint set {}: its {} is {:g}, where {} is expected",
                                                            number, what, value, expected));
    };
    if (!(set.dip >= 0.0 && set.dip <= 0.5 * std::numbers::pi)) fail("dip", set.dip, "0 to pi/2 rad");
    if (!std::isfinite(set.dip_direction)) fail("dip direction", set.dip_direction, "a finite angle");
    if (!(set.spacing > 0.0 && std::isfinite(set.spacing))) fail("spacing", set.spacing, "a positive length");
    if (!(set.spacing_scatter >= 0.0 && set.spacing_scatter < 1.0))
        fail("spacing scatter", set.spacing_scatter, "[0, 1)");
    if (!(set.angle_scatter >= 0.0 && set.angle_scatter <= 0.3))
        fail("angle scatter", set.angle_scatter, "[0, 0.3] rad");
}

// The plane through `middle` + `along` of the set's normal, turned a little about that point. `random`: the joint's
// own.
CutPlane joint(const JointSet& set, const Vec3& middle, double along, Random& random) {
    const Vec3 mean = upward_normal(set.dip, set.dip_direction);
    const Vec3 strike = Vec3(std::cos(set.dip_direction), -std::sin(set.dip_direction), 0.0);
    const double a = set.angle_scatter * random.normal(), b = set.angle_scatter * random.normal();
    const Vec3 normal = (mean + a * strike + b * mean.cross(strike)).normalized();
    return {normal, normal.dot(middle + along * mean)};
}

// All joints of a set that may reach a body of the radius [m] around `middle`.
std::vector<CutPlane> joints_of(const JointSet& set, std::uint64_t seed, std::uint64_t number, const Vec3& middle,
                                double radius, std::size_t most) {
    std::vector<CutPlane> joints;
    Random first(seed, 2 * number, 0);
    const double start = set.spacing * (first.uniform() - 0.5);
    joints.push_back(joint(set, middle, start, first));
    // where it starts on the normal through the middle, for it to reach the ball when it is turned by 4 deviations
    const double farthest = radius / std::cos(std::min(4.0 * set.angle_scatter, 1.2));
    for (const std::uint64_t side : {0, 1}) {
        double along = start;
        for (std::uint64_t k = 1;; ++k) {
            Random random(seed, 2 * number + side, k);
            const double step = set.spacing * random.uniform(1.0 - set.spacing_scatter, 1.0 + set.spacing_scatter);
            along += side == 0 ? step : -step;
            if (std::abs(along) > farthest) break;
            joints.push_back(joint(set, middle, along, random));
            if (joints.size() > most)
                throw ShapeError(ShapeFault::no_volume,
                                 fmt::format("joint set {}: a spacing of {:g} m makes more than {} joints", number,
                                             set.spacing, most));
        }
    }
    return joints;
}

}  // namespace

Vec3 upward_normal(double dip, double dip_direction) {
    return {std::sin(dip) * std::sin(dip_direction), std::sin(dip) * std::cos(dip_direction), std::cos(dip)};
}

RockMass cut_rock_mass(const Polyhedron& body, const std::vector<JointSet>& sets, std::uint64_t seed,
                       std::size_t most) {
    const Extent extent = extent_of(body.vertex);
    const double size = extent.size();
    std::vector<Polyhedron> blocks = {body};
    for (std::size_t s = 0; s < sets.size(); ++s) {
        check_set(sets[s], s);
        for (const CutPlane& plane : joints_of(sets[s], seed, s, extent.middle(), 0.5 * size, most)) {
            const std::size_t before = blocks.size();
            for (std::size_t k = 0; k < before; ++k) {
                CutParts parts = cut(blocks[k], plane, kThinnest * size);
                if (parts.below.face.empty() || parts.above.face.empty()) continue;
                blocks[k] = std::move(parts.below);
                blocks.push_back(std::move(parts.above));
            }
            if (blocks.size() > most)
                throw ShapeError(ShapeFault::no_volume, fmt::format("the joints make more than {} blocks", most));
        }
    }
    RockMass mass;
    mass.volume = volume_integrals(body).volume;
    for (const Polyhedron& block : blocks) {
        try {
            mass.blocks.push_back(make_shape(block));
        } catch (const ShapeError& error) {
            if (error.fault() != ShapeFault::no_volume) throw;
            ++mass.slivers;
            mass.lost += volume_integrals(block).volume;
        }
    }
    return mass;
}

}  // namespace scree::scenarios
