// All contacts of a step in scenes with polyhedra: those of find_contacts.hpp, but a pair may touch at several points,
// and bodies turn, so that each contact has its own point and its own relative velocity there.
#pragma once

#include "contact/find_contacts.hpp"
#include "contact/polyhedra/narrow_phase.hpp"

namespace scree::contact {

class RigidContactFinder {
  public:
    // As find_contacts(); `points` [m]: of each contact, half-way between the surfaces. Bodies are at the middle of the
    // step, with their spins there.
    void find(const Scene& scene, const State& state, const StepTimes& times, const CandidateList& candidates,
              const Domain& domain, ContactSet& contacts, std::vector<Vec3>& points);
    std::size_t bytes() const { return narrow_.bytes(); }

  private:
    NarrowPhase narrow_;
};

}  // namespace scree::contact
