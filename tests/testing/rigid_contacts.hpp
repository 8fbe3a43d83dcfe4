// Random contacts of bodies of many shapes, a batch at a time: for the kernels and for the slow solution of them.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "solvers/rigid_assembly.hpp"
#include "tests/testing/slow_rigid.hpp"

namespace scree::testing {

// Moments of inertia over m r^2.
enum class Shape { sphere, grain, plate, needle };

struct RigidContacts {
    static constexpr int kBodies = 2 * kLanes;
    std::array<Vec3, kBodies> position;
    std::array<solvers::RigidLine, kBodies + 1> line{};
    std::array<solvers::RigidContactData, kLanes> data;
    std::array<Vec3, kLanes> impulse;
    solvers::RigidFrictionalBatch friction{};
    solvers::RigidFrictionlessBatch frictionless{};

    // Contacts i of bodies i and i + 8, the last one of body 7 with the ground. `lever`: of the size of the lever arms
    // beside the bodies' own; spheres have theirs along the normal.
    RigidContacts(std::uint64_t seed, Shape shape, double mu, double lever = 1.0) {
        Random random(seed, 1, static_cast<std::uint64_t>(shape));
        const auto vector = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
        std::array<double, kBodies> radius{};
        for (std::size_t i = 0; i < kBodies; ++i) {
            radius[i] = random.uniform(0.1, 2.0);
            solvers::RigidLine& l = line[i + 1];
            l.inverse_mass = std::exp(random.uniform(-3.0, 3.0));
            const Vec3 v = vector(), w = vector() / radius[i];
            Mat3 turn;
            turn.col(0) = vector().normalized();
            turn.col(1) = turn.col(0).cross(vector()).normalized();
            turn.col(2) = turn.col(0).cross(turn.col(1));
            Vec3 moments = Vec3::Constant(0.4);
            if (shape == Shape::grain)
                moments = Vec3(random.uniform(0.2, 0.6), random.uniform(0.4, 0.6), random.uniform(0.3, 0.6));
            if (shape == Shape::plate) moments = Vec3(0.5, 0.25, 0.25);
            if (shape == Shape::needle) moments = Vec3(1e-6, 1.0, 1.0);
            const Vec3 inverse = l.inverse_mass / (radius[i] * radius[i]) * moments.cwiseInverse();
            const auto j = [&](int d, int e) {
                if (shape == Shape::sphere) return d == e ? inverse[0] : 0.0;
                double sum = 0.0;
                for (int k = 0; k < 3; ++k) sum += inverse[k] * turn(d, k) * turn(e, k);
                return sum;
            };
            for (int d = 0; d < 3; ++d) l.v[d] = v[d], l.w[d] = w[d], l.j[d] = j(d, d);
            l.j[3] = j(0, 1), l.j[4] = j(0, 2), l.j[5] = j(1, 2);
        }
        for (std::size_t i = 0; i < kLanes; ++i) {
            const bool ground = i == kLanes - 1;
            const Vec3 n = vector().normalized();
            solvers::RigidContactData& c = data[i];
            c.normal = n;
            c.ra = shape == Shape::sphere ? Vec3(-radius[i] * n) : Vec3(lever * radius[i] * vector());
            c.rb = shape == Shape::sphere ? Vec3(radius[i + 8] * n) : Vec3(lever * radius[i + 8] * vector());
            c.friction = mu;
            c.bias = random.normal();
            position[i] = vector();
            position[i + 8] = position[i] + c.ra - c.rb;
            if (ground) c.rb.setZero();
            friction.a[i] = frictionless.a[i] = static_cast<std::uint32_t>(i + 1);
            friction.b[i] = frictionless.b[i] = ground ? solvers::kGround : static_cast<std::uint32_t>(i + 9);
            const solvers::RigidLine &a = line[friction.a[i]], &b = line[friction.b[i]];
            const int k = static_cast<int>(i);
            set_lane(friction, k, c, a, b);
            set_lane(frictionless, k, c, a, b);
            const double pn = std::max(0.0, random.normal()) / (a.inverse_mass + b.inverse_mass);
            impulse[i] = pn * n + std::min(mu, 5.0) * pn * random.uniform() * n.cross(vector()).normalized();
            set_world_impulse(friction, k, impulse[i]);
            set_world_impulse(frictionless, k, impulse[i]);
        }
    }
    SlowRigidContact::V3 tangential(int lane) const {
        using V3 = SlowRigidContact::V3;
        const V3 n(friction.n[0][lane], friction.n[1][lane], friction.n[2][lane]);
        const V3 t(friction.t[0][lane], friction.t[1][lane], friction.t[2][lane]);
        return friction.p[1][lane] * t + friction.p[2][lane] * n.cross(t);
    }
    // The contact of a lane as it is now.
    SlowRigidContact slow(int lane) const {
        using V3 = SlowRigidContact::V3;
        const auto at = static_cast<std::size_t>(lane);
        const auto body = [&](std::uint32_t k, const Vec3& r) {
            const solvers::RigidLine& l = line[k];
            SlowRigidContact::Body b;
            b.v = V3(l.v[0], l.v[1], l.v[2]);
            b.w = V3(l.w[0], l.w[1], l.w[2]);
            b.r = r.cast<long double>();
            b.inverse_mass = l.inverse_mass;
            b.inverse_inertia << l.j[0], l.j[3], l.j[4], l.j[3], l.j[1], l.j[5], l.j[4], l.j[5], l.j[2];
            return b;
        };
        SlowRigidContact c;
        c.a = body(friction.a[lane], data[at].ra);
        c.b = body(friction.b[lane], data[at].rb);
        c.n = data[at].normal.cast<long double>();
        c.mu = data[at].friction;
        c.bias = data[at].bias;
        c.p = friction.p[0][lane] * c.n + tangential(lane);
        return c;
    }
};

}  // namespace scree::testing
