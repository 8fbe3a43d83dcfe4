// Where two bodies touch: a few points that together carry what the patch of contact can carry.
//
// A point's key names the features that meet in it, so that its impulse is found again in the next step:
//   vertex of a on a face of b (the vertex alone: it stays the same contact as it slides from face to face),
//   vertex of b on a face of a, or an edge of a across an edge of b.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/vec.hpp"

namespace scree::contact {

using FeatureKey = std::uint32_t;

// Two bits of kind, fifteen of each body's feature: shapes have at most 2^15 vertices, edges and faces.
inline constexpr std::uint32_t kMostFeatures = 1U << 15U;
enum class Meeting : std::uint32_t { vertex_of_a = 0, vertex_of_b = 1, edges = 2 };

inline FeatureKey feature_key(Meeting meeting, std::uint32_t of_a, std::uint32_t of_b) {
    return static_cast<std::uint32_t>(meeting) << 30U | of_a << 15U | of_b;
}
// The key of the same place when a and b change names.
inline FeatureKey mirrored(FeatureKey key) {
    const std::uint32_t kind = key >> 30U, of_a = key >> 15U & (kMostFeatures - 1), of_b = key & (kMostFeatures - 1);
    return (kind == 2 ? kind : 1 - kind) << 30U | of_b << 15U | of_a;
}

struct ManifoldPoint {
    Vec3 point;   // [m] world, half-way between the surfaces
    Vec3 normal;  // unit, from b to a
    double gap;   // [m] along the normal, negative where they overlap
    FeatureKey key;
};

struct Manifold {
    static constexpr int kCapacity = 8;
    std::array<ManifoldPoint, kCapacity> item;
    int count = 0;
    double area = 0.0;  // [m2] of the convex hull of the points, seen along the normal

    void add(const ManifoldPoint& point) {
        if (count < kCapacity) item[static_cast<std::size_t>(count++)] = point;
    }
    std::span<const ManifoldPoint> points() const { return {item.data(), static_cast<std::size_t>(count)}; }
};

}  // namespace scree::contact
