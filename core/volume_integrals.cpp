#include "core/volume_integrals.hpp"

#include <cmath>

namespace scree {

VolumeIntegrals volume_integrals(const Polyhedron& body) {
    double volume = 0.0, area = 0.0;
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    for (const auto& loop : body.face) {
        const Vec3& a = body.vertex[loop[0]];
        for (std::size_t k = 2; k < loop.size(); ++k) {
            const Vec3 &b = body.vertex[loop[k - 1]], &c = body.vertex[loop[k]];
            // from the sides, which are shorter: a . (b x c) = a . ((b - a) x (c - a))
            const Vec3 normal = (b - a).cross(c - a);
            const double d = a.dot(normal);
            const Vec3 s = a + b + c;
            area += 0.5 * normal.norm();
            volume += d / 6.0;
            first += d / 24.0 * s;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j <= i; ++j)
                    second(i, j) += d / 120.0 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + s[i] * s[j]);
        }
    }
    const Vec3 centre = first / volume;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j) second(j, i) = second(i, j) -= volume * centre[i] * centre[j];
    return {volume, centre, second, area};
}

Mat3 principal_axes(const Mat3& second, double noise) {
    constexpr int kMostRounds = 32;  // quadratic convergence: five or six do
    Mat3 c = second, axes = Mat3::Identity();
    const double negligible = noise * c.diagonal().cwiseAbs().maxCoeff();
    for (int round = 0; round < kMostRounds; ++round) {
        bool turned = false;
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (std::abs(c(p, q)) <= negligible) continue;
                turned = true;
                // the smaller of the two angles that make c(p, q) zero (Golub and Van Loan, section 8.5)
                const double theta = (c(q, q) - c(p, p)) / (2.0 * c(p, q));
                const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
                const double cosine = 1.0 / std::sqrt(t * t + 1.0), sine = t * cosine;
                Mat3 turn = Mat3::Identity();
                turn(p, p) = turn(q, q) = cosine;
                turn(p, q) = sine;
                turn(q, p) = -sine;
                c = (turn.transpose() * c * turn).eval();
                c(p, q) = c(q, p) = 0.0;
                axes = (axes * turn).eval();
            }
        if (!turned) break;
    }
    return axes;
}

}  // namespace scree
