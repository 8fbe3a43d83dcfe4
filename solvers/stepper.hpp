// The time step of Moreau and Jean (Moreau 1988; Jean 1999) with theta = 1/2:
//   q_m  = q + (h/2) v                         contacts are found here
//   v_f  = v + h g
//   v+   = v_f + M^-1 H p,   u = H^T v+,       K_mu ∋ p ⟂ (ũ_N + mu |u_T|) n + u_T ∈ K_mu*     every contact
//   q+   = q_m + (h/2) v+                      then the position-level correction of penetration
// q [m], v [m/s], p [N s]; ũ_N = u_N + e u_N^-. Method and references: solvers/README.md.
#pragma once

#include <memory>
#include <vector>

#include "core/contact_record.hpp"
#include "core/parallel/communicator.hpp"
#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "core/step_report.hpp"
#include "solvers/rank_report.hpp"

namespace scree::solvers {

// What the bodies did to one wall in the last scenario step (all its substeps).
struct WallLoad {
    Vec3 impulse = Vec3::Zero();  // [N s] on the wall
    Vec3 angular = Vec3::Zero();  // [N m s] about the scene's local origin
    std::size_t contacts = 0;     // with an impulse
};

class Stepper {
  public:
    // `ranks` must outlive the stepper. All functions that take a state are collective.
    Stepper(const Scene& scene, const Plan& plan, const Communicator& ranks = Communicator::self());
    ~Stepper();

    // Before the first step and the first look at bodies by measures: bodies, which may lie on any ranks, go to where
    // they belong. Does nothing with one rank, or when it was done; advance() does it too.
    void start(State& state);

    // One scenario step: from state.time to state.time + time.step, cut into substeps when bodies are too fast. Adds to
    // state.totals and to the ledger; inlets and outlets act at its end. Throws PhysicsError on non-finite velocities.
    StepReport advance(State& state);

    // Contacts of the last (sub)step in order of key, and the loads on the walls in the last scenario step.
    // Records are made only if plan.contact_records.
    const std::vector<ContactRecord>& contacts() const;
    const std::vector<WallLoad>& wall_loads() const;  // one a wall
    double last_step() const;                         // [s] length of the last scenario step

    // What this rank has and did so far, as a part of many.
    RankReport rank_report(const State& state) const;

    // Bytes held by the stepper's own arrays (not the state's).
    std::size_t bytes() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace scree::solvers
