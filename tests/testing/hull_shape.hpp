// Convex shapes for tests, by trying all triples of points: slow, and short enough to be seen to be right.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/convex_shape.hpp"
#include "core/random.hpp"

namespace scree::testing {

namespace detail {

struct Plane {
    Vec3 normal;
    double offset;
    std::vector<std::uint32_t> on;
};

// Planes through three points with none beyond; points nearer than `same` to it lie on it.
inline std::vector<Plane> hull_planes(const std::vector<Vec3>& p, double same) {
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < p.size(); ++i) {
        for (std::size_t j = i + 1; j < p.size(); ++j) {
            for (std::size_t k = j + 1; k < p.size(); ++k) {
                const Vec3 across = (p[j] - p[i]).cross(p[k] - p[i]);
                if (across.norm() < same * same) continue;
                for (const double side : {1.0, -1.0}) {
                    Plane plane{side * across.normalized(), side * across.normalized().dot(p[i]), {}};
                    bool outer = true;
                    for (std::uint32_t q = 0; q < p.size() && outer; ++q) {
                        const double above = plane.normal.dot(p[q]) - plane.offset;
                        if (std::abs(above) <= same) plane.on.push_back(q);
                        outer = above <= same;
                    }
                    const auto known = [&](const Plane& other) { return other.on == plane.on; };
                    if (outer && std::none_of(planes.begin(), planes.end(), known)) planes.push_back(plane);
                }
            }
        }
    }
    return planes;
}

}  // namespace detail

// The convex hull; every point must be a corner of it. The origin goes to the centre of mass, the axes stay.
inline ConvexShape hull_shape(std::vector<Vec3> points) {
    double scale = 0.0;
    for (const Vec3& p : points) scale = std::max(scale, (p - points[0]).norm());
    std::vector<detail::Plane> planes = detail::hull_planes(points, 1e-10 * scale);
    ConvexShape shape;
    for (detail::Plane& plane : planes) {  // corners by angle about the middle of the face
        Vec3 middle = Vec3::Zero();
        for (const std::uint32_t i : plane.on) middle += points[i] / static_cast<double>(plane.on.size());
        const Vec3 u = (points[plane.on[0]] - middle).normalized(), v = plane.normal.cross(u);
        std::sort(plane.on.begin(), plane.on.end(), [&](std::uint32_t i, std::uint32_t j) {
            const Vec3 x = points[i] - middle, y = points[j] - middle;
            return std::atan2(v.dot(x), u.dot(x)) < std::atan2(v.dot(y), u.dot(y));
        });
    }
    Vec3 moment = Vec3::Zero();
    for (const detail::Plane& plane : planes) {
        for (std::size_t k = 1; k + 1 < plane.on.size(); ++k) {
            const Vec3 x = points[plane.on[0]] - points[0], y = points[plane.on[k]] - points[0],
                       z = points[plane.on[k + 1]] - points[0];
            const double volume = x.dot(y.cross(z)) / 6.0;
            shape.volume += volume;
            moment += 0.25 * volume * (x + y + z);
        }
    }
    const Vec3 centre = points[0] + moment / shape.volume;
    for (const Vec3& p : points) shape.vertex.push_back(p - centre);
    shape.inner_radius = scale;
    for (const detail::Plane& plane : planes) {
        double offset = 0.0;
        for (const std::uint32_t i : plane.on) {
            offset += plane.normal.dot(shape.vertex[i]) / static_cast<double>(plane.on.size());
        }
        shape.face.push_back({plane.normal, offset, static_cast<std::uint32_t>(shape.corner.size()),
                              static_cast<std::uint32_t>(plane.on.size())});
        shape.corner.insert(shape.corner.end(), plane.on.begin(), plane.on.end());
        shape.inner_radius = std::min(shape.inner_radius, offset);
    }
    for (const Vec3& v : shape.vertex) shape.radius = std::max(shape.radius, v.norm());
    for (std::uint32_t f = 0; f < shape.face.size(); ++f) {
        const auto c = shape.corners(f);
        for (std::size_t k = 0; k < c.size(); ++k) {
            const std::uint32_t from = c[k], to = c[(k + 1) % c.size()];
            if (from > to) continue;
            for (std::uint32_t g = 0; g < shape.face.size(); ++g) {
                const auto d = shape.corners(g);
                for (std::size_t m = 0; m < d.size(); ++m) {
                    if (d[m] == to && d[(m + 1) % d.size()] == from) shape.edge.push_back({from, to, f, g});
                }
            }
        }
    }
    for (std::uint32_t v = 0; v < shape.vertex.size(); ++v) {
        shape.link_begin.push_back(static_cast<std::uint32_t>(shape.link.size()));
        for (std::uint32_t w = 0; w < shape.vertex.size(); ++w) {
            for (const auto& e : shape.edge) {
                if ((e.from == v && e.to == w) || (e.from == w && e.to == v)) shape.link.push_back(w);
            }
        }
    }
    shape.link_begin.push_back(static_cast<std::uint32_t>(shape.link.size()));
    return shape;
}

inline ConvexShape box_shape(const Vec3& sides) {
    std::vector<Vec3> points;
    for (int i = 0; i < 8; ++i) {
        points.push_back(0.5 * sides.cwiseProduct(Vec3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0)));
    }
    return hull_shape(points);
}

inline ConvexShape tetrahedron_shape(double side) {
    const double h = side / std::sqrt(8.0);
    return hull_shape({{h, h, h}, {h, -h, -h}, {-h, h, -h}, {-h, -h, h}});
}

inline Vec3 random_direction(Random& random) {
    for (;;) {
        const Vec3 x(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
        if (x.norm() > 0.1 && x.norm() < 1.0) return x.normalized();
    }
}
inline Quat random_turn(Random& random) {
    return Quat(Eigen::AngleAxisd(random.uniform(0.0, 6.28), random_direction(random)));
}

// A rock with so many vertices, on an ellipsoid with the given half axes: all of them are corners.
inline ConvexShape rock_shape(int vertices, const Vec3& half_axes, Random& random) {
    std::vector<Vec3> points;
    for (int i = 0; i < vertices; ++i) points.push_back(half_axes.cwiseProduct(random_direction(random)));
    return hull_shape(points);
}

}  // namespace scree::testing
