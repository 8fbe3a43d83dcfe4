// Position-level correction of penetration, and its measure. Velocities are not touched, so no kinetic energy is added.
//   find displacements d = M^-1 H p of least sum m |d|^2 with   0 <= p ⟂ n . (d_a - d_b) + c >= 0   at every contact,
//   c = share * gap where bodies overlap, c = gap where they do not (so that none is pushed into a neighbour),
// by a few Gauss-Seidel sweeps (Moreau and Jean's scheme leaves penetration where it is: Acary 2013 discusses the
// projection). Gaps are those at the end of the step, from the step's contacts by the motion of the centres: exact
// between spheres and at planes, to second order of the motion at curved walls.
#pragma once

#include "contact/contact_set.hpp"
#include "core/settings.hpp"
#include "core/state.hpp"
#include "core/step_report.hpp"
#include "solvers/contact_problem.hpp"

namespace scree::solvers {

struct CorrectionReport {
    Penetration penetration;  // after the correction
    double work = 0.0;        // [J] added to the potential energy
    int sweeps = 0;
};

template <class Law>
class PositionCorrection {
  public:
    // `state` has the positions of the step's end; `problem` the solved velocities.
    CorrectionReport apply(const ContactProblem<Law>& problem, const contact::ContactSet& contacts,
                           const Layout& layout, const CorrectionSettings& settings, double step, const Vec3& gravity,
                           State& state);
    // End gap of each contact of the last call, in order of key (for contact records).
    void gaps(const Layout& layout, std::vector<double>& gap) const;
    std::size_t bytes() const;

  private:
    struct alignas(64) Gaps {
        double gap[kLanes];        // [m] at the end of the step, without the correction
        double bias[kLanes];       // c [m]
        double p[kLanes];          // [kg m]
        double diameter[kLanes];   // [m] mean of the two bodies'; of the body at a wall; 0 in unused lanes
        double curvature[kLanes];  // [1/m] 1 / distance of the centres; 0 at a wall
    };
    double deepest(const ContactProblem<Law>& problem, const contact::ContactSet& contacts, const Layout& layout,
                   const CorrectionSettings& settings, double step, const State& state);
    Penetration measure(const ContactProblem<Law>& problem) const;

    LineVector<Gaps> gaps_;
    LineVector<SlidingLine> line_;  // displacements, beside the problem's lines
};

extern template class PositionCorrection<Frictional>;
extern template class PositionCorrection<Frictionless>;

}  // namespace scree::solvers
