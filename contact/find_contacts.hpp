// All contacts of a step, with the bodies at the middle of the step.
#pragma once

#include "contact/candidate_list.hpp"
#include "contact/contact_set.hpp"
#include "core/parallel/domain.hpp"
#include "core/plan.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::contact {

// Gaps smaller than this share of the radii are contact: round-off must not decide whether touching bodies touch.
inline constexpr double kTouch = 1e-10;

struct StepTimes {
    double begin;  // [s]
    double step;   // h [s]
    double middle() const { return begin + 0.5 * step; }
};

// How far each body can close a gap in half a step [m]: look_ahead * (h/2) (|v| + h |g|), at least with look_ahead 1;
// |v| is that of the fastest point, where bodies are not spheres.
// False if a position or velocity is not finite: no grid can hold what is nowhere.
bool contact_margins(const Scene& scene, const State& state, const StepTimes& times, std::vector<double>& margin);

// `state.bodies.position` holds q_m, `velocity` and `spin` are those at the start of the step.
// `candidates` were updated for this step. Contacts come out in order of key, on each rank those that it solves.
void find_contacts(const Scene& scene, const State& state, const StepTimes& times, const CandidateList& candidates,
                   const Domain& domain, ContactSet& contacts);

}  // namespace scree::contact
