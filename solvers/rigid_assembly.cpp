#include "solvers/rigid_assembly.hpp"

#include <algorithm>
#include <cmath>

namespace scree::solvers {
namespace {

// d^T R^T J R e, from R d and R e. Written out: a matrix product's order of sums is its library's.
double rotational(const RigidLine& line, const Vec3& r_d, const Vec3& r_e) {
    const double* const j = line.j;
    return r_d.dot(Vec3((j[0] * r_e[0] + j[3] * r_e[1]) + j[4] * r_e[2],
                        (j[3] * r_e[0] + j[1] * r_e[1]) + j[5] * r_e[2],
                        (j[4] * r_e[0] + j[5] * r_e[1]) + j[2] * r_e[2]));
}

// A unit vector across `n`: the axis that lies farthest from it, the first of equals, made orthogonal.
Vec3 across(const Vec3& n) {
    int axis = 0;
    for (int d = 1; d < 3; ++d)
        if (std::abs(n[d]) < std::abs(n[axis])) axis = d;
    const Vec3 t = Vec3::Unit(axis) - n[axis] * n;
    return t / t.norm();
}

// Cosine and sine of the angle that makes (p q; q r) diagonal with the smaller eigenvalue first; 1 and 0 if they are
// equal. tan(2 angle) by the stable formula of Jacobi's method (Golub and Van Loan, Matrix Computations).
struct Turn {
    double c = 1.0, s = 0.0;
};
Turn principal_turn(double p, double q, double r) {
    Turn turn;
    if (q != 0.0) {
        const double tau = (r - p) / (2.0 * q);
        const double t = (tau >= 0.0 ? 1.0 : -1.0) / (std::abs(tau) + std::sqrt(1.0 + tau * tau));
        turn.c = 1.0 / std::sqrt(1.0 + t * t);
        turn.s = -t * turn.c;
        p -= t * q;
        r += t * q;
    }
    if (r < p) turn = {-turn.s, turn.c};
    return turn;
}

void put(double (&to)[3][kLanes], int lane, const Vec3& from) {
    for (int d = 0; d < 3; ++d) to[d][lane] = from[d];
}
Vec3 get(const double (&from)[3][kLanes], int lane) {
    return {from[0][lane], from[1][lane], from[2][lane]};
}

}  // namespace

Mat3 delassus_block(const RigidContactData& contact, const RigidLine& a, const RigidLine& b, const Mat3& frame) {
    Mat3 w;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k <= i; ++k) {
            const Vec3 d = frame.col(i), e = frame.col(k);
            const double rolled = rotational(a, contact.ra.cross(d), contact.ra.cross(e)) +
                                  rotational(b, contact.rb.cross(d), contact.rb.cross(e));
            w(i, k) = w(k, i) = rolled + (i == k ? a.inverse_mass + b.inverse_mass : 0.0);
        }
    return w;
}

void set_lane(RigidFrictionalBatch& batch, int lane, const RigidContactData& contact, const RigidLine& a,
              const RigidLine& b) {
    const double mass = a.inverse_mass + b.inverse_mass;
    Mat3 frame;
    frame.col(0) = contact.normal;
    frame.col(1) = across(contact.normal);
    frame.col(2) = contact.normal.cross(frame.col(1));
    const Mat3 w = delassus_block(contact, a, b, frame);
    const double wn = w(0, 0), k_t = w(0, 1) / wn, k_s = w(0, 2) / wn;
    const double tt = w(1, 1) - w(0, 1) * k_t, ts = w(1, 2) - w(0, 1) * k_s, ss = w(2, 2) - w(0, 2) * k_s;
    const Turn turn = principal_turn(tt, ts, ss);
    const Vec3 t = turn.c * frame.col(1) + turn.s * frame.col(2);
    // W - (1/m_a + 1/m_b) 1 is not negative, nor is it in S: what round-off takes away is given back
    const auto along = [&](double c, double s) { return std::max((c * c * tt + 2.0 * c * s * ts) + s * s * ss, mass); };
    const double a1 = along(turn.c, turn.s), a2 = std::max(along(-turn.s, turn.c), a1);
    put(batch.n, lane, contact.normal);
    put(batch.t, lane, t);
    put(batch.ra, lane, contact.ra);
    put(batch.rb, lane, contact.rb);
    batch.bias[lane] = contact.bias;
    batch.friction[lane] = contact.friction;
    batch.wn[lane] = wn;
    batch.inverse_wn[lane] = 1.0 / wn;
    batch.coupling[0][lane] = turn.c * k_t + turn.s * k_s;
    batch.coupling[1][lane] = turn.c * k_s - turn.s * k_t;
    batch.inverse_at[lane] = 1.0 / a1;
    batch.at_ratio[lane] = a1 / a2;
    put(batch.p, lane, Vec3::Zero());
}

void set_lane(RigidFrictionlessBatch& batch, int lane, const RigidContactData& contact, const RigidLine& a,
              const RigidLine& b) {
    const Vec3 ra_n = contact.ra.cross(contact.normal), rb_n = contact.rb.cross(contact.normal);
    put(batch.n, lane, contact.normal);
    put(batch.ra_n, lane, ra_n);
    put(batch.rb_n, lane, rb_n);
    batch.bias[lane] = contact.bias;
    batch.inverse_w[lane] =
        1.0 / ((a.inverse_mass + b.inverse_mass) + (rotational(a, ra_n, ra_n) + rotational(b, rb_n, rb_n)));
    batch.p[0][lane] = 0.0;
}

Vec3 world_impulse(const RigidFrictionalBatch& batch, int lane) {
    const Vec3 n = get(batch.n, lane), t = get(batch.t, lane), p = get(batch.p, lane);
    return p[0] * n + p[1] * t + p[2] * n.cross(t);
}
Vec3 world_impulse(const RigidFrictionlessBatch& batch, int lane) {
    return batch.p[0][lane] * get(batch.n, lane);
}
void set_world_impulse(RigidFrictionalBatch& batch, int lane, const Vec3& impulse) {
    const Vec3 n = get(batch.n, lane), t = get(batch.t, lane);
    put(batch.p, lane, {impulse.dot(n), impulse.dot(t), impulse.dot(n.cross(t))});
}
void set_world_impulse(RigidFrictionlessBatch& batch, int lane, const Vec3& impulse) {
    batch.p[0][lane] = impulse.dot(get(batch.n, lane));
}

}  // namespace scree::solvers
