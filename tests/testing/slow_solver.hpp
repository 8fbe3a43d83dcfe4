// The contact problem once more, slow and plain, in long double: one contact after the other, no packs, no batches,
// no acceleration. Written from the equations, to compare the engine with.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/contact_set.hpp"
#include "core/bodies.hpp"

namespace scree::testing {

class SlowSolver {
  public:
    using Real = long double;
    using V3 = Eigen::Matrix<Real, 3, 1>;
    struct Body {
        V3 v = V3::Zero(), omega = V3::Zero();
        Real radius = 0, inverse_mass = 0, inverse_inertia = 0;
    };
    struct Contact {
        std::size_t a, b;  // bodies; walls are bodies too
        V3 n;
        Real bias, mu;
        V3 p = V3::Zero();
    };

    SlowSolver(const contact::ContactSet& contacts, const Bodies& bodies, const Vec3& dv_free,
               const std::vector<Vec3>& wall_velocity = {}) {
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            Body b;
            b.v = (bodies.velocity[i] + dv_free).cast<Real>();
            b.radius = bodies.radius[i];
            b.inverse_mass = 1 / static_cast<Real>(bodies.mass[i]);
            if (bodies.has_spin()) {
                b.omega = bodies.spin[i].cast<Real>();
                b.inverse_inertia = b.inverse_mass * 5 / 2 / (b.radius * b.radius);
            }
            body.push_back(b);
        }
        for (std::size_t c = 0; c < contacts.size(); ++c) {
            const contact::Contact& from = contacts[c];
            std::size_t b = from.b;
            if (from.key.is_wall()) {
                b = body.size();
                body.emplace_back();
                if (!wall_velocity.empty()) body.back().v = wall_velocity[c].cast<Real>();
            }
            contact.push_back({from.a, b, from.normal.cast<Real>().normalized(), from.bias, from.friction});
        }
    }

    // Relative velocity at the contact point, of a against b.
    V3 velocity(const Contact& c) const {
        const Body &a = body[c.a], &b = body[c.b];
        return (a.v + a.omega.cross(V3(-a.radius * c.n))) - (b.v + b.omega.cross(V3(b.radius * c.n)));
    }
    void push(const Contact& c, const V3& d) {
        Body &a = body[c.a], &b = body[c.b];
        a.v += a.inverse_mass * d;
        b.v -= b.inverse_mass * d;
        a.omega += a.inverse_inertia * V3(-a.radius * c.n).cross(d);
        b.omega += b.inverse_inertia * V3(b.radius * c.n).cross(V3(-d));
    }
    Real normal_delassus(const Contact& c) const { return body[c.a].inverse_mass + body[c.b].inverse_mass; }
    Real tangent_delassus(const Contact& c) const {
        const Body &a = body[c.a], &b = body[c.b];
        return normal_delassus(c) + a.inverse_inertia * a.radius * a.radius + b.inverse_inertia * b.radius * b.radius;
    }
    // Signorini and Coulomb at one contact, the others held.
    void solve(Contact& c) {
        const V3 u = velocity(c);
        const Real wn = normal_delassus(c), wt = tangent_delassus(c), un = u.dot(c.n), pn = c.p.dot(c.n);
        const V3 free_t = (u - un * c.n) - wt * (c.p - pn * c.n);  // slip if the contact had no tangential impulse
        const Real normal = std::max<Real>(0, -(un - wn * pn + c.bias) / wn);
        V3 tangent = -free_t / wt;
        const Real size = tangent.norm(), limit = c.mu * normal;
        if (size > limit) tangent *= limit / size;
        const V3 p = normal * c.n + tangent;
        push(c, p - c.p);
        c.p = p;
    }
    void sweep(int times) {
        for (int k = 0; k < times; ++k)
            for (Contact& c : contact) solve(c);
    }
    // |F| [m/s], F = (p - P_K(p - rho û)) / rho, rho = 3 / tr W.
    Real natural_map(const Contact& c, bool frictional = true) const {
        const V3 u = velocity(c);
        const Real rho = frictional ? 3 / (normal_delassus(c) + 2 * tangent_delassus(c)) : 1 / normal_delassus(c);
        const Real un = u.dot(c.n);
        const V3 ut = u - un * c.n;
        const V3 x = c.p - rho * ((un + c.bias + c.mu * ut.norm()) * c.n + ut);
        const Real xn = x.dot(c.n);
        const V3 xt = x - xn * c.n;
        const Real size = xt.norm();
        V3 projected = x;
        if (c.mu * size <= -xn) {
            projected = V3::Zero();
        } else if (size > c.mu * xn) {
            const Real to = (xn + c.mu * size) / (1 + c.mu * c.mu);
            projected = to * c.n + c.mu * to / size * xt;
        }
        return (c.p - projected).norm() / rho;
    }

    std::vector<Body> body;
    std::vector<Contact> contact;
};

}  // namespace scree::testing
