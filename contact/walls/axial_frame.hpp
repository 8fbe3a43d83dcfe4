// Coordinates of a point about an axis: height, distance from the axis, and the unit vectors that go with them.
// Private to contact/.
#pragma once

#include <cmath>
#include <limits>

#include "core/vec.hpp"

namespace scree::contact::detail {

// Squares of lengths below 1e-146 lose digits; such short vectors are scaled first, so that no length is too short.
inline double length_of(const Vec3& v) {
    const double square = v.squaredNorm();
    return square > 0x1p-970 ? std::sqrt(square) : v.stableNorm();
}

struct AxialFrame {
    double height;    // [m] along the axis, from the base
    double distance;  // [m] from the axis
    Vec3 across;      // [m] from the axis to the point
    double size;      // [m] from the base to the point

    AxialFrame(const Vec3& point, const Vec3& base, const Vec3& axis) {
        const Vec3 relative = point - base;
        height = relative.dot(axis);
        across = relative - height * axis;
        distance = length_of(across);
        size = length_of(relative);
    }

    // Unit, from the axis to the point. Below a few units of round-off of the point's own coordinates the direction is
    // noise: the point is on the axis, and the direction a fixed one.
    Vec3 outward(const Vec3& axis) const {
        constexpr double kNoise = 8.0 * std::numeric_limits<double>::epsilon();
        const Vec3 direction = distance > kNoise * size ? Vec3(across / distance) : any_perpendicular(axis);
        return (direction - direction.dot(axis) * axis).normalized();
    }

    static Vec3 any_perpendicular(const Vec3& axis) {
        int smallest = 0;
        axis.cwiseAbs().minCoeff(&smallest);
        return (Vec3::Unit(smallest) - axis[smallest] * axis).normalized();
    }
};

// A sphere that fills a round hole touches it all round: three points a third of a turn apart hold it.
struct Turn {
    double cosine, sine;

    Vec3 of(const Vec3& outward, const Vec3& axis) const { return cosine * outward + sine * axis.cross(outward); }
};
inline constexpr double kSineThird = 0.86602540378443864676;
inline constexpr Turn kThirds[3] = {{1.0, 0.0}, {-0.5, kSineThird}, {-0.5, -kSineThird}};

}  // namespace scree::contact::detail
