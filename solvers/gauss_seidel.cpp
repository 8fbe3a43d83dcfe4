#include "solvers/gauss_seidel.hpp"

#include <algorithm>
#include <limits>

namespace scree::solvers {
namespace {

constexpr double kMaxOverRms = 16.0;  // allowed maximum of the natural map over its allowed rms

// Bodies at rest on faces: a step that takes over impulses and velocities which are within the tolerance hands errors
// on to the next one, and with a few sweeps a step these feed one another (a pyramid of cubes goes on trembling with 2,
// is still with 4; a wall of 20 courses takes 10). Sweeps are cheap beside the detection of polyhedra.
constexpr int kLeastRigid = 16;

// The step length of the extrapolation.
class Momentum {
  public:
    double next(double change) {
        const bool shrinks = change <= last_change_ && last_change_ > 0.0;
        const double beta = shrinks ? change / last_change_ : 0.0;
        last_change_ = change;
        return beta;
    }

  private:
    double last_change_ = std::numeric_limits<double>::infinity();
};

}  // namespace

template <class Law>
SolveReport gauss_seidel(ContactProblem<Law>& problem, const SolverSettings& settings) {
    SolveReport report;
    if (problem.contacts() == 0) return report;
    const bool accelerate = settings.method == SolverMethod::conjugate_gauss_seidel;
    const auto good = [&](const Residual& r) {
        return r.rms <= settings.tolerance && r.max <= kMaxOverRms * settings.tolerance;
    };
    problem.begin_single(settings);
    if (accelerate) problem.reset_momentum();
    Momentum momentum;
    double beta = 0.0;
    int next_check = Law::kRigid ? std::max(kLeastRigid, settings.min_sweeps) : settings.min_sweeps;
    for (;;) {
        const double change = problem.sweep(beta, accelerate);
        ++report.sweeps;
        // a sweep that changes nothing is a fixed point: none after it can do better
        const bool last = report.sweeps >= settings.max_sweeps || change == 0.0;
        // the change of a sweep tells when a look at the residual is worth its price
        if (last || (report.sweeps >= next_check && change <= settings.tolerance)) {
            report.residual = problem.residual();
            ++report.residual_checks;
            report.converged = good(report.residual);
            if ((last || report.converged) && problem.single()) {
                // what counts is the residual in double precision; if it is too large, sweeps go on in that
                problem.end_single();
                report.residual = problem.residual();
                ++report.residual_checks;
                report.converged = good(report.residual);
                if (report.converged || report.sweeps >= settings.max_sweeps) return report;
                if (accelerate) problem.reset_momentum();
                momentum = {};
                beta = 0.0;
                next_check = report.sweeps + 1;
                continue;
            }
            if (last || report.converged) return report;
            next_check = report.sweeps + 1 + report.sweeps / 16;
        }
        if (accelerate) beta = momentum.next(change);
    }
}

template SolveReport gauss_seidel(ContactProblem<Frictional>&, const SolverSettings&);
template SolveReport gauss_seidel(ContactProblem<Frictionless>&, const SolverSettings&);
template SolveReport gauss_seidel(ContactProblem<RigidFrictional>&, const SolverSettings&);
template SolveReport gauss_seidel(ContactProblem<RigidFrictionless>&, const SolverSettings&);

}  // namespace scree::solvers
