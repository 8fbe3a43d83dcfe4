// Position-level correction of penetration, and its measure. Velocities are not touched, so no kinetic energy is added.
//   find displacements d = M^-1 H p of least sum m |d|^2 with   0 <= p ⟂ n . (d_a - d_b) + c >= 0   at every contact,
//   c = share * gap where bodies overlap, c = gap where they do not (so that none is pushed into a neighbour),
// by a few Gauss-Seidel sweeps of the frictionless kernel, over the overlaps at the end of the step and the neighbours
// of those who overlap (contact/near_contacts.hpp). Velocity-level schemes leave penetration where it is (Acary 2013
// discusses projections that do not).
#pragma once

#include "contact/near_contacts.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "core/step_report.hpp"
#include "solvers/layout.hpp"
#include "solvers/line_exchange.hpp"
#include "solvers/single_problem.hpp"

namespace scree::solvers {

struct CorrectionReport {
    Penetration penetration;  // after the correction; `mean` over `closed` contacts
    double work = 0.0;        // [J] added to the potential energy
    int sweeps = 0;
};

class PositionCorrection {
  public:
    // `state` has the positions of the end of the step from state.time on. `closed`: contacts with an impulse in this
    // step, over which the mean penetration is taken (overlaps count too).
    // Collective; the report is that of all ranks.
    CorrectionReport apply(const Scene& scene, double step, std::size_t closed, contact::CandidateList& candidates,
                           Domain& domain, State& state);
    const Traffic& traffic() { return exchange_.traffic(); }
    std::size_t bytes() const;

  private:
    void assemble(const contact::ContactSet& contacts, const Bodies& bodies, double share);
    // Returns the number of sweeps.
    int sweep(const Scene& scene, const contact::ContactSet& contacts, const State& state, const Communicator& ranks);
    Penetration measure(const contact::ContactSet& contacts, const Bodies& bodies, const Communicator& ranks,
                        std::size_t closed) const;

    contact::NearContacts near_;
    Layout layout_;
    LineExchange exchange_;
    Sweeps<Frictionless, double> full_;  // lines are displacements [m]
    SingleProblem<Frictionless> single_;
};

}  // namespace scree::solvers
