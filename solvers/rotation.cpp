#include "solvers/rotation.hpp"

#include <cmath>

namespace scree::solvers {
namespace {

// A turn by `angle` about axis k.
Quat about_axis(int k, double angle) {
    Quat q(std::cos(0.5 * angle), 0.0, 0.0, 0.0);
    q.vec()[k] = std::sin(0.5 * angle);
    return q;
}

bool is_sphere(const Vec3& inertia) {
    return inertia[0] == inertia[2];  // they increase
}

}  // namespace

Quat turned(const Quat& orientation, const Vec3& turn) {
    const double angle = turn.norm();
    if (!(angle > 0.0)) return orientation;
    Quat q;
    q.w() = std::cos(0.5 * angle);
    q.vec() = (std::sin(0.5 * angle) / angle) * turn;
    return (q * orientation).normalized();
}

Quat rotated_freely(const Quat& orientation, const Vec3& inertia, const Vec3& momentum, double time) {
    if (momentum.isZero(0.0)) return orientation;
    const double first = 1.0 / inertia[0] - 1.0 / inertia[1], third = 1.0 / inertia[2] - 1.0 / inertia[1];
    Quat q = orientation;
    // about the body's own axis k, by its own share of l_k
    const auto spin_about = [&](int k, double rate, double tau) {
        if (rate == 0.0) return;
        const double l = (q.conjugate() * momentum)[k];
        q = q * about_axis(k, tau * rate * l);
    };
    spin_about(0, first, 0.5 * time);
    spin_about(2, third, time);
    spin_about(0, first, 0.5 * time);
    return turned(q, (time / inertia[1]) * momentum);
}

Vec3 angular_momentum(const Quat& orientation, const Vec3& inertia, const Vec3& spin) {
    if (is_sphere(inertia)) return inertia[0] * spin;
    return orientation * inertia.cwiseProduct(orientation.conjugate() * spin);
}

Vec3 spin_of(const Quat& orientation, const Vec3& inertia, const Vec3& momentum) {
    if (is_sphere(inertia)) return momentum / inertia[0];
    return orientation * (orientation.conjugate() * momentum).cwiseQuotient(inertia);
}

Mat3 inverse_inertia(const Quat& orientation, const Vec3& inertia) {
    if (is_sphere(inertia)) return Mat3::Identity() / inertia[0];
    const Mat3 r = orientation.toRotationMatrix();
    const Vec3 inverse = inertia.cwiseInverse();
    Mat3 j;  // written out: in which order a library's product adds up depends on the width of registers
    for (int d = 0; d < 3; ++d)
        for (int e = 0; e <= d; ++e)
            j(d, e) = j(e, d) = (inverse[0] * (r(d, 0) * r(e, 0)) + inverse[1] * (r(d, 1) * r(e, 1))) +
                                inverse[2] * (r(d, 2) * r(e, 2));
    return j;
}

void move_freely(Bodies& bodies, double time, ExactSum& gain) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies.position[i] += time * bodies.velocity[i];
        Vec3& spin = bodies.spin[i];
        if (spin.isZero(0.0)) continue;
        const Vec3& inertia = bodies.inertia[i];
        const Vec3 momentum = angular_momentum(bodies.orientation[i], inertia, spin);
        bodies.orientation[i] = rotated_freely(bodies.orientation[i], inertia, momentum, time);
        if (is_sphere(inertia)) continue;
        const Vec3 after = spin_of(bodies.orientation[i], inertia, momentum);
        if (!bodies.is_ghost(i)) gain.add(0.5 * momentum.dot(after - spin));
        spin = after;
    }
}

}  // namespace scree::solvers
