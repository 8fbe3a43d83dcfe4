// One step of Moreau and Jean's scheme of a given length: the method of solvers/stepper.hpp in one function.
#pragma once

#include <chrono>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "contact/candidate_list.hpp"
#include "contact/find_contacts.hpp"
#include "contact/find_rigid_contacts.hpp"
#include "core/contact_record.hpp"
#include "core/parallel/domain.hpp"
#include "core/plan.hpp"
#include "solvers/contact_problem.hpp"
#include "solvers/gauss_seidel.hpp"
#include "solvers/layout.hpp"
#include "solvers/position_correction.hpp"
#include "solvers/rigid_correction.hpp"
#include "solvers/stepper.hpp"

namespace scree::solvers {

// Measures the phases of a step: lap(phase) gives the time since the last lap to that phase.
class PhaseClock {
  public:
    explicit PhaseClock(RunTotals& totals) : totals_(totals) {}
    void lap(Phase phase) {
        const auto now = std::chrono::steady_clock::now();
        totals_.wall_by_phase[static_cast<std::size_t>(phase)] += std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

  private:
    RunTotals& totals_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

template <class Law>
class Substep {
  public:
    Substep(const Scene& scene, const Plan& plan, Domain& domain)
        : scene_(scene), plan_(plan), domain_(domain), problem_(domain.ranks()) {
        if (!domain.alone()) problem_.exchange_by(&exchange_);
    }

    // From state.time to state.time + step. Adds to the loads on the walls.
    StepReport advance(State& state, double step, std::vector<WallLoad>& loads);
    // Bodies came, went or changed ranks.
    void bodies_changed() { candidates_.invalidate(); }
    const std::vector<ContactRecord>& records() const { return records_; }
    // Appends the work of this rank's blocks in the last step.
    void add_work(std::vector<BlockWork>& work) const;
    Traffic traffic();
    std::size_t contacts() const { return contacts_.size(); }
    std::size_t bytes() const;

  private:
    static constexpr bool kRigid = Law::kRigid, kFrictional = Law::kImpulse == 3;

    void move(Bodies& bodies, double time);
    CorrectionReport correct(State& state, double step);
    Vec3 point_of(std::size_t c, const Bodies& bodies) const;
    void find_contacts(State& state, const contact::StepTimes& times);
    void set_up(State& state, const contact::StepTimes& times);
    void start_impulses(const State& state, double step);
    void keep_ledger(State& state, const contact::StepTimes& times, StepReport& report, std::vector<WallLoad>& loads);
    void add_wall_loads(const State& state, std::span<ExactSum, 4> sums, std::span<ExactSum> load,
                        std::span<std::uint64_t> contacts) const;
    void make_records(const State& state, const contact::StepTimes& times);

    const Scene& scene_;
    const Plan& plan_;
    Domain& domain_;
    LineExchange exchange_;
    contact::CandidateList candidates_;
    contact::ContactSet contacts_;
    std::vector<Vec3> points_;  // [m] of the contacts; empty where all bodies are spheres
    std::conditional_t<kRigid, contact::RigidContactFinder, std::monostate> finder_;
    Layout layout_;
    ContactProblem<Law> problem_;
    std::conditional_t<kRigid, RigidCorrection, PositionCorrection> correction_;
    ExactSum rotation_gain_;                // [J] of a step; see rotation.hpp
    std::vector<ExactSum> sums_;            // of a step, over ranks
    std::vector<std::uint64_t> counts_;     // bodies, contacts with an impulse, those of each wall
    std::size_t active_ = 0;                // contacts of this rank with an impulse
    std::vector<double> margin_;            // [m], n
    std::vector<Vec3> wall_velocity_;       // [m/s], one a contact; empty without moving walls
    std::vector<Vec3> impulse_;             // [N s], one a contact (friction)
    std::vector<double> impulse_normal_;    // [N s], one a contact (no friction)
    std::vector<std::uint32_t> unmatched_;  // impulses of the last step without a contact here
    std::vector<ContactRecord> records_;
};

extern template class Substep<Frictional>;
extern template class Substep<Frictionless>;
extern template class Substep<RigidFrictional>;
extern template class Substep<RigidFrictionless>;

}  // namespace scree::solvers
