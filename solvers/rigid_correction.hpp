// Position-level correction of penetration for bodies of any shape: displacements and turns d = M^-1 H p of least
// sum m |d|^2 + J |turn|^2 with
//   0 <= p ⟂ n . (d_a - d_b) + c >= 0       at every contact of the step,
//   c from the gap at the end of the step,  g + (h/2) n . u+,  to first order of the motion (position_correction.hpp),
//   0 where bodies overlap by less than 5e-5 of a diameter: deeper ones come out to there,
// by frictionless Gauss-Seidel sweeps in the step's own layout: the contacts are those that the step has found, so that
// polyhedra are not compared a second time. Done at the middle of the step, where normals and arms are known. Spins
// turn with their bodies: no kinetic energy is added.
#pragma once

#include "contact/contact_set.hpp"
#include "contact/near_contacts.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "solvers/layout.hpp"
#include "solvers/line_exchange.hpp"
#include "solvers/position_correction.hpp"
#include "solvers/rigid_batch.hpp"
#include "solvers/sweeps.hpp"

namespace scree::solvers {

// The contacts of a step as its problem had them.
struct StepContacts {
    const contact::ContactSet& contacts;
    const std::vector<Vec3>& points;         // [m]
    const std::vector<Vec3>& wall_velocity;  // [m/s], one a contact; empty without moving walls
    const Layout& layout;
};

class RigidCorrection {
  public:
    // `state` has the positions of the middle of the step from state.time on and the velocities of its end; positions
    // are changed there. `closed`: contacts with an impulse, over which the mean penetration is taken. Collective.
    CorrectionReport apply(const Scene& scene, double step, std::size_t closed, const StepContacts& of_step,
                           LineExchange& exchange, const Domain& domain, State& state);
    // Of the contacts [m], at the end of the step before anything is corrected.
    const std::vector<double>& gaps() const { return gap_; }
    Traffic traffic() const { return {}; }  // the step's exchange counts
    std::size_t bytes() const { return sweeps_.bytes() + gap_.capacity() * sizeof(double); }

  private:
    void find_gaps(const StepContacts& of_step, double step, const State& state);
    void assemble(const StepContacts& of_step, const Bodies& bodies, double share);
    double displace(const Layout& layout, const Vec3& gravity, const Communicator& ranks, Bodies& bodies) const;
    Penetration measure(const StepContacts& of_step, const State& state, const Communicator& ranks,
                        std::size_t closed) const;

    std::vector<double> gap_;                   // [m] at the end of the step, one a contact
    Sweeps<RigidFrictionless, double> sweeps_;  // lines are displacements [m] and turns [rad]
    bool moved_ = false;                        // the lines are those of this step
};

}  // namespace scree::solvers
