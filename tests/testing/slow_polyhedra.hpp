// The gap of two convex polyhedra by trying everything: all pairs of features for the distance, all normals of faces
// and all cross products of edges for the depth. Nothing of the code under test but place() is used.
#pragma once

#include "contact/polyhedra/placed.hpp"
#include "tests/testing/hull_shape.hpp"

namespace scree::testing {

using contact::Placed;

struct Body {  // owns the room of a placed shape
    Body(const ConvexShape& shape, const Vec3& position, const Quat& orientation)
        : room(contact::placed_size(shape)), placed(contact::place(shape, position, orientation, room)) {}
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;
    operator const Placed&() const { return placed; }

    std::vector<Vec3> room;
    Placed placed;
};

struct SlowGap {
    double gap;
    Vec3 normal;  // from b to a
};

inline double slow_separation(const Placed& a, const Placed& b, const Vec3& n) {
    double low = 1e300, high = -1e300;
    for (const Vec3& x : a.vertex) low = std::min(low, n.dot(x + (a.position - b.position)));
    for (const Vec3& x : b.vertex) high = std::max(high, n.dot(x));
    return low - high;
}

// How far x is outside of the body's planes; negative inside.
inline double slow_outside(const Placed& body, const Vec3& x) {
    double most = -1e300;
    for (std::size_t f = 0; f < body.normal.size(); ++f) {
        most = std::max(most, body.normal[f].dot(x - body.position - body.vertex[body.shape->corners(f)[0]]));
    }
    return most;
}

inline SlowGap slow_depth(const Placed& a, const Placed& b) {
    SlowGap best{-1e300, Vec3::Zero()};
    const auto attempt = [&](const Vec3& n) {
        for (const double side : {1.0, -1.0}) {
            const double s = slow_separation(a, b, side * n);
            if (s > best.gap) best = {s, side * n};
        }
    };
    for (const Vec3& n : a.normal) attempt(n);
    for (const Vec3& n : b.normal) attempt(n);
    for (const auto& e : a.shape->edge) {
        for (const auto& f : b.shape->edge) {
            const Vec3 d = (a.vertex[e.to] - a.vertex[e.from]).normalized();
            const Vec3 c = (b.vertex[f.to] - b.vertex[f.from]).normalized();
            if (d.cross(c).norm() > 1e-9) attempt(d.cross(c).normalized());
        }
    }
    return best;
}

// The vector from the nearest point of polygon f to x, where the foot lies within it.
inline bool foot_within(const Placed& body, std::size_t f, const Vec3& x, Vec3& from_foot) {
    const auto corners = body.shape->corners(f);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 &p = body.vertex[corners[k]], &q = body.vertex[corners[(k + 1) % corners.size()]];
        if (body.normal[f].dot((q - p).cross(x - p)) < 0.0) return false;
    }
    from_foot = body.normal[f].dot(x - body.vertex[corners[0]]) * body.normal[f];
    return true;
}

// Nearest points of two segments: both inside, or an end of one and the nearest point of the other.
inline Vec3 between_segments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1) {
    Vec3 best = p0 - q0;
    const auto take = [&](const Vec3& d) {
        if (d.norm() < best.norm()) best = d;
    };
    const auto from_segment = [](const Vec3& x, const Vec3& s0, const Vec3& s1) -> Vec3 {
        const double t = std::clamp((x - s0).dot(s1 - s0) / (s1 - s0).squaredNorm(), 0.0, 1.0);
        return x - (s0 + t * (s1 - s0));
    };
    take(from_segment(p0, q0, q1)), take(from_segment(p1, q0, q1));
    take(-from_segment(q0, p0, p1)), take(-from_segment(q1, p0, p1));
    const Vec3 d = p1 - p0, e = q1 - q0, r = p0 - q0, n = d.cross(e);
    const double square = n.squaredNorm();
    if (square > 1e-20 * d.squaredNorm() * e.squaredNorm()) {
        const double s = -r.cross(e).dot(n) / square, t = -r.cross(d).dot(n) / square;
        if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) take((p0 + s * d) - (q0 + t * e));
    }
    return best;
}

inline SlowGap slow_distance(const Placed& a, const Placed& b) {
    const Vec3 r = a.position - b.position;
    Vec3 best = Vec3::Constant(1e100);
    const auto take = [&](const Vec3& d) {
        if (d.norm() < best.norm()) best = d;
    };
    Vec3 d;
    for (std::size_t f = 0; f < b.normal.size(); ++f) {
        for (const Vec3& x : a.vertex) {
            if (foot_within(b, f, x + r, d)) take(d);
        }
    }
    for (std::size_t f = 0; f < a.normal.size(); ++f) {
        for (const Vec3& x : b.vertex) {
            if (foot_within(a, f, x - r, d)) take(-d);
        }
    }
    for (const auto& e : a.shape->edge) {
        for (const auto& f : b.shape->edge) {
            take(between_segments(a.vertex[e.from] + r, a.vertex[e.to] + r, b.vertex[f.from], b.vertex[f.to]));
        }
    }
    return {best.norm(), best.normalized()};
}

inline SlowGap slow_gap(const Placed& a, const Placed& b) {
    const SlowGap depth = slow_depth(a, b);
    return depth.gap <= 0.0 ? depth : slow_distance(a, b);
}

}  // namespace scree::testing
