// Nonlinear Gauss-Seidel over contacts (Jean 1999), accelerated: each sweep starts from impulses extrapolated along
// their last change,   s = y + beta (y - y_previous),   y the result of a sweep.
// beta follows Nesterov's sequence (t + 1 = (1 + sqrt(1 + 4 t^2)) / 2) and starts anew when the change of a sweep
// grows: the restart that Silcowitz-Hansen et al. (2010) use for their conjugate gradient around the sweep.
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
// The impulses returned are those of a sweep, inside their cones.
template <class Law>
SolveReport gauss_seidel(ContactProblem<Law>& problem, const SolverSettings& settings);

extern template SolveReport gauss_seidel(ContactProblem<Frictional>&, const SolverSettings&);
extern template SolveReport gauss_seidel(ContactProblem<Frictionless>&, const SolverSettings&);

}  // namespace scree::solvers
