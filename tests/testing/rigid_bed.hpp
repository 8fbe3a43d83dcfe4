// The contacts of a bed of spheres as those of bodies of another shape: with the inertia of ellipsoids, and contact
// points beside the line of centres. For what works on many contacts in the order of a layout.
#pragma once

#include <cstdint>

#include "core/bodies.hpp"
#include "core/random.hpp"
#include "solvers/rigid_assembly.hpp"
#include "solvers/sweeps.hpp"

namespace scree::testing {

enum class BedShape { spheres, grains };

// Velocities of the bodies (spins, if they have them) and `dv_free` into the lines.
template <class Law>
solvers::Sweeps<Law, double> rigid_bed(const Bodies& bodies, const contact::ContactSet& contacts,
                                       const solvers::Layout& layout, const Vec3& dv_free, BedShape shape) {
    solvers::Sweeps<Law, double> bed;
    const bool grains = shape == BedShape::grains;
    bed.line.assign(bodies.size() + 1, {});
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        Random random(2, 0, i);
        const auto vector = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
        solvers::RigidLine& line = bed.line[layout.line(i)];
        line.inverse_mass = 1.0 / bodies.mass[i];
        Mat3 turn;
        turn.col(0) = vector().normalized();
        turn.col(1) = turn.col(0).cross(vector()).normalized();
        turn.col(2) = turn.col(0).cross(turn.col(1));
        // half axes of 1 : 0.8 : 0.6 radii
        const Vec3 moments = grains ? Vec3(0.2, 0.272, 0.328) : Vec3(0.4, 0.4, 0.4);
        const double r2 = bodies.radius[i] * bodies.radius[i];
        const Mat3 j = turn * Vec3((r2 * bodies.mass[i] * moments).cwiseInverse()).asDiagonal() * turn.transpose();
        for (int d = 0; d < 3; ++d) {
            line.v[d] = bodies.velocity[i][d] + dv_free[d];
            if (bodies.has_spin()) line.w[d] = bodies.spin[i][d];
            line.j[d] = j(d, d);
        }
        line.j[3] = j(0, 1), line.j[4] = j(0, 2), line.j[5] = j(1, 2);
    }
    bed.batch.assign(layout.batches(), {});
    for (std::size_t k = 0; k < bed.batch.size(); ++k)
        for (int i = 0; i < kLanes; ++i) {
            const std::uint32_t index = layout.lanes()[k][static_cast<std::size_t>(i)];
            if (index == solvers::kNoContact) continue;
            const contact::Contact& c = contacts[index];
            auto& batch = bed.batch[k];
            batch.a[i] = layout.line(c.a);
            if (!c.key.is_wall()) batch.b[i] = layout.line(c.b);
            Random random(3, 0, index);
            const double beside = grains ? 0.3 * bodies.radius[c.a] : 0.0;
            Vec3 ra = -bodies.radius[c.a] * c.normal;
            for (int d = 0; d < 3; ++d) ra[d] += beside * random.uniform(-1.0, 1.0);
            Vec3 rb = Vec3::Zero();
            if (!c.key.is_wall()) rb = ra + (bodies.position[c.a] - bodies.position[c.b]);
            set_lane(batch, i, {c.normal, ra, rb, c.friction, c.bias}, bed.line[batch.a[i]], bed.line[batch.b[i]]);
        }
    return bed;
}

}  // namespace scree::testing
