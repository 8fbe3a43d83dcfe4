// The shortest way between two segments, from q to p. Private to this folder.
#pragma once

#include <algorithm>

#include "core/vec.hpp"

namespace scree::contact::detail {

inline Vec3 from_segment(const Vec3& x, const Vec3& s0, const Vec3& s1) {
    const Vec3 d = s1 - s0;
    return x - (s0 + std::clamp((x - s0).dot(d) / d.squaredNorm(), 0.0, 1.0) * d);
}

// An end of one and the other, or both inner parts where they cross. A difference of points of theirs in any case, so
// never shorter than the shortest by more than round-off, however nearly parallel they are.
inline Vec3 between_segments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1) {
    Vec3 best = from_segment(p0, q0, q1);
    const auto take = [&](const Vec3& way) {
        if (way.squaredNorm() < best.squaredNorm()) best = way;
    };
    take(from_segment(p1, q0, q1));
    take(-from_segment(q0, p0, p1));
    take(-from_segment(q1, p0, p1));
    const Vec3 d = p1 - p0, e = q1 - q0, r = q0 - p0, n = d.cross(e);
    const double square = n.squaredNorm();
    if (square <= 1e-24 * d.squaredNorm() * e.squaredNorm()) return best;  // parallel
    const double s = r.cross(e).dot(n) / square, t = r.cross(d).dot(n) / square;
    if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0) take((p0 + s * d) - (q0 + t * e));
    return best;
}

}  // namespace scree::contact::detail
