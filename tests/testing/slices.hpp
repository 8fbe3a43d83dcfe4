// Slow oracles for the hull of a few points, which know nothing of faces that the code under test has made.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "core/polyhedron.hpp"

namespace scree::testing {

// Volume, centre of mass and second moments about it.
struct Moments {
    double volume = 0.0;
    Vec3 centre = Vec3::Zero();
    Mat3 second = Mat3::Zero();
};

// The hull of points in a plane by Andrew's monotone chain (1979).
inline std::vector<Eigen::Vector2d> plane_hull(std::vector<Eigen::Vector2d> points) {
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
    std::vector<Eigen::Vector2d> hull;
    const auto add = [&hull](const Eigen::Vector2d& x, std::size_t keep) {
        while (hull.size() >= keep + 2) {
            const Eigen::Vector2d a = hull.back() - hull[hull.size() - 2], b = x - hull.back();
            if (a.x() * b.y() - a.y() * b.x() > 0.0) break;
            hull.pop_back();
        }
        hull.push_back(x);
    };
    for (const auto& x : points) add(x, 0);
    const std::size_t lower = hull.size() - 1;
    for (auto it = points.rbegin() + 1; it != points.rend(); ++it) add(*it, lower);
    hull.pop_back();
    return hull;
}

// Integrals over the hull of points, slice by slice: a plane z = const cuts it in the hull of the crossings of all
// pairs of points. Between two levels of points the integrands are polynomials of z of degree 4, which Gauss's rule of
// three nodes integrates exactly. Uses points alone.
inline Moments moments_by_slices(const std::vector<Vec3>& points) {
    std::vector<double> levels;
    Vec3 middle = Vec3::Zero();
    for (const Vec3& x : points) middle += x / static_cast<double>(points.size());
    for (const Vec3& x : points) levels.push_back(x.z());
    std::sort(levels.begin(), levels.end());
    Moments m;
    for (std::size_t level = 1; level < levels.size(); ++level) {
        const double half = 0.5 * (levels[level] - levels[level - 1]);
        for (const auto& [node, weight] :
             {std::pair{-std::sqrt(0.6), 5.0 / 9.0}, {0.0, 8.0 / 9.0}, {std::sqrt(0.6), 5.0 / 9.0}}) {
            const double z = levels[level - 1] + half * (1.0 + node);
            std::vector<Eigen::Vector2d> crossings;
            for (const Vec3& a : points)
                for (const Vec3& b : points) {
                    if (!(a.z() < z && z < b.z())) continue;
                    const Vec3 x = a + (z - a.z()) / (b.z() - a.z()) * (b - a) - middle;
                    crossings.emplace_back(x.x(), x.y());
                }
            if (crossings.size() < 3) continue;
            const auto hull = plane_hull(crossings);
            const double zz = z - middle.z();
            for (std::size_t k = 2; k < hull.size();
                 ++k) {  // the triangle's integrals by its mid-side rule, exact to degree 2
                const Eigen::Vector2d u = hull[k - 1] - hull[0], v = hull[k] - hull[0];
                const double area = 0.5 * (u.x() * v.y() - u.y() * v.x()) * weight * half;
                for (const Eigen::Vector2d& side :
                     std::array<Eigen::Vector2d, 3>{hull[0] + 0.5 * u, hull[0] + 0.5 * v, hull[0] + 0.5 * (u + v)}) {
                    const Vec3 x(side.x(), side.y(), zz);
                    m.volume += area / 3.0;
                    m.centre += area / 3.0 * x;
                    m.second += area / 3.0 * x * x.transpose();
                }
            }
        }
    }
    m.centre /= m.volume;
    m.second -= m.volume * m.centre * m.centre.transpose();
    m.centre += middle;
    return m;
}

// Triangles of the hull of points in general position: three points with all others on one side. n^4 steps.
inline Polyhedron brute_hull(const std::vector<Vec3>& points) {
    Polyhedron hull{points, {}};
    const auto n = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = i + 1; j < n; ++j)
            for (std::uint32_t k = i + 1; k < n; ++k) {
                if (k == j) continue;
                const Vec3 normal = (points[j] - points[i]).cross(points[k] - points[i]);
                bool outside = true;
                for (std::uint32_t l = 0; l < n && outside; ++l)
                    outside = l == i || l == j || l == k || normal.dot(points[l] - points[i]) < 0.0;
                if (outside) hull.face.push_back({i, j, k});
            }
    return hull;
}

// J about the principal axes, increasing, from second moments: the slow oracle's answer.
inline Vec3 principal_moments(const Mat3& second) {
    const Mat3 inertia = second.trace() * Mat3::Identity() - second;
    return Eigen::SelfAdjointEigenSolver<Mat3>(inertia).eigenvalues();
}

}  // namespace scree::testing
