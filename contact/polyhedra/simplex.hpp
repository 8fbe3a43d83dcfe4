// The point of a simplex (point, segment, triangle, tetrahedron) nearest to the origin, and the corners that hold it
// (Ericson 2005, 5.1). Private to this folder.
#pragma once

#include <array>
#include <cstdint>

#include "core/vec.hpp"

namespace scree::contact::detail {

struct SimplexCorner {
    Vec3 w = Vec3::Zero();       // [m] x - y
    std::uint32_t a = 0, b = 0;  // vertices x and y
    double weight = 0.0;
};

struct Simplex {
    std::array<SimplexCorner, 4> corner;
    int size = 0;
    bool holds_origin = false;  // a tetrahedron about the origin

    Vec3 nearest() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) sum += corner[i].weight * corner[i].w;
        return sum;
    }
    // Leaves only the corners whose hull holds the nearest point, with their weights.
    void reduce();
};

}  // namespace scree::contact::detail
