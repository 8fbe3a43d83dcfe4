// The contact problem of one step, laid out for the kernels: find p with u = H^T (v_free + M^-1 H p) and every
// contact's law. Holds the velocities (lines) that belong to the impulses (batches) at all times.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/contact_set.hpp"
#include "core/aligned_vector.hpp"
#include "core/exact_sum.hpp"
#include "core/parallel/communicator.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "solvers/batch.hpp"
#include "solvers/layout.hpp"
#include "solvers/line_exchange.hpp"
#include "solvers/rigid_batch.hpp"
#include "solvers/single_problem.hpp"

namespace scree::solvers {

struct Residual {
    double rms = 0.0, max = 0.0;  // of the natural map over v_ref (solvers/README.md)
};
// Work of the contacts [J]: normal, tangential, and of those contacts alone that together added energy.
using ContactWorkSums = std::span<ExactSum, 3>;

template <class Law>
class ContactProblem {
  public:
    using Line = typename Law::template LineOf<double>;
    using Batch = typename Law::template BatchOf<double>;

    explicit ContactProblem(const Communicator& ranks = Communicator::self()) : ranks_(ranks) {}
    // Lines of shared bodies travel by this; null with one rank. All that follows is collective.
    void exchange_by(LineExchange* exchange) { exchange_ = exchange; }

    // Free velocities into the lines (v + h g), contacts into the batches with zero impulses.
    // `wall_velocity`: of each moving-wall contact in order of key, others ignored. `points` [m]: of each contact, if
    // bodies are not spheres.
    void assemble(const contact::ContactSet& contacts, const Layout& layout, const State& state, const Vec3& dv_free,
                  const std::vector<Vec3>& wall_velocity, const std::vector<Vec3>& points = {});
    // v_ref = sqrt(sum |q|^2 / contacts), at least `floor` [m/s], from the free velocities in the lines.
    void scale(double floor);
    // Some |q| is not zero; otherwise zero impulses are the solution.
    bool driven() const { return driven_; }
    // Impulses to start from, in order of key: applied to the lines.
    void warm_start(const std::vector<Vec3>& impulse, const std::vector<double>& normal);

    // From here on sweeps and residuals are in single precision, if the settings and the numbers allow it; momentum is
    // forgotten. Returns whether they are.
    bool begin_single(const SolverSettings& settings);
    bool single() const { return is_single_; }
    // Back to double precision: the impulses in their cones, the lines rebuilt.
    void end_single();

    // One Gauss-Seidel sweep; with `beta` > 0 it starts from impulses extrapolated by beta along their last change, and
    // so are the lines. Returns the size of the change, sqrt(sum |W_N r|^2 / contacts) / v_ref.
    double sweep(double beta, bool momentum);
    // Forgets the last change of impulses: the next sweep starts where the last one ended.
    void reset_momentum();

    Residual residual();
    // Work of this rank's impulses on the mean of the velocities before (state) and after (lines).
    void add_work(const State& state, ContactWorkSums total);
    // Makes the lines anew from the free velocities and the impulses: what hundreds of sweeps and extrapolations left
    // of round-off is gone. `state` (that of assemble) has the velocities before the step.
    void rebuild_lines();
    // Velocities and spins of the bodies after the step.
    void velocities(State& state) const;
    // Impulses in order of key.
    void impulses(std::vector<Vec3>& impulse, std::vector<double>& normal) const;

    std::uint64_t contacts() const { return all_contacts_; }  // of all ranks
    double reference_velocity() const { return v_ref_; }
    const std::vector<Block>& blocks() const { return layout_->blocks(); }
    const LineVector<Batch>& batches() const { return full_.batch; }
    std::size_t batches_in_sweep() const { return is_single_ ? single_.sweeps.batch.size() : full_.batch.size(); }
    const LineVector<Line>& lines() const { return full_.line; }
    const Line& line_of(std::size_t body) const { return full_.line[layout_->line(body)]; }
    std::size_t bytes() const;

  private:
    static constexpr bool kSpins = Law::kImpulse == 3 || Law::kRigid;  // lines hold spins

    void fill_lane(Batch& batch, int lane, const contact::Contact& contact, const Vec3* point);
    void free_lines();

    const Communicator& ranks_;
    LineExchange* exchange_ = nullptr;
    const Layout* layout_ = nullptr;
    const State* state_ = nullptr;
    Vec3 dv_free_ = Vec3::Zero();
    std::size_t contacts_ = 0, bodies_ = 0;
    std::uint64_t all_contacts_ = 0;
    double v_ref_ = 0.0;
    bool driven_ = false;
    bool swept_ = false;  // since the lines were built
    bool is_single_ = false;
    Extremes extremes_;
    Sweeps<Law, double> full_;
    SingleProblem<Law> single_;  // empty if never used
    LineVector<Line> line_mean_;
};

extern template class ContactProblem<Frictional>;
extern template class ContactProblem<Frictionless>;
extern template class ContactProblem<RigidFrictional>;
extern template class ContactProblem<RigidFrictionless>;

}  // namespace scree::solvers
