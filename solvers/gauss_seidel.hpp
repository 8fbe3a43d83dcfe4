// Nonlinear Gauss-Seidel over contacts (Jean 1999) with a conjugate-gradient-like acceleration around the sweep, after
// Silcowitz-Hansen, Niebe and Erleben (2010): each sweep starts from impulses extrapolated along their last change,
//   s = y + beta (y - y_previous),    y the result of a sweep,    beta = |r_k| / |r_k-1|,    r = y - s the sweep's
//   change;
// beta = 0, a new start, when |r| grows. Compared on settled beds with Fletcher and Reeves' beta = |r_k|^2 / |r_k-1|^2
// and with Nesterov's sequence: all three need a fifth to a tenth of the plain sweeps at a residual of 1e-2, and this
// one is ahead by a tenth to a third at 10 to 100 sweeps. The extrapolation needs no sum in the kernel, so it costs a
// read of y_previous and no further pass over the contacts.
#pragma once

#include "core/settings.hpp"
#include "solvers/contact_problem.hpp"

namespace scree::solvers {

struct SolveReport {
    int sweeps = 0;
    int residual_checks = 0;
    Residual residual;  // at the end
    bool converged = true;
};

// Sweeps until the scaled natural map is at most the tolerance (its maximum 16 times that), or max_sweeps.
// The impulses returned are inside their cones, and the residual is in double precision, whatever the sweeps are in.
template <class Law>
SolveReport gauss_seidel(ContactProblem<Law>& problem, const SolverSettings& settings);

extern template SolveReport gauss_seidel(ContactProblem<Frictional>&, const SolverSettings&);
extern template SolveReport gauss_seidel(ContactProblem<Frictionless>&, const SolverSettings&);
extern template SolveReport gauss_seidel(ContactProblem<RigidFrictional>&, const SolverSettings&);
extern template SolveReport gauss_seidel(ContactProblem<RigidFrictionless>&, const SolverSettings&);

}  // namespace scree::solvers
