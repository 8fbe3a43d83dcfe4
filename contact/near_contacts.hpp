// What the correction of positions must know at the end of a step: the overlaps, and the neighbours into which it may
// push the overlapping bodies.
#pragma once

#include <vector>

#include "contact/candidate_list.hpp"
#include "contact/contact_set.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace scree::contact {

class NearContacts {
  public:
    // Contacts in order of key, gaps exact at the end of the step; `bias` and `friction` are 0. A body may be pushed as
    // far as its deepest overlap d_i, or one of those whom it may be pushed into; a pair is near if its gap is below
    // d_i + d_j. Overlaps below 1e-4 of the diameter push nobody; if there are no others the set is empty.
    const ContactSet& find(const Scene& scene, const State& state, double step, CandidateList& candidates);
    // The overlaps that are in no contact of the set.
    struct Shallow {
        std::size_t count = 0;
        double max = 0.0, sum = 0.0;                    // [m]
        double max_relative = 0.0, sum_relative = 0.0;  // of the diameter
    };
    const Shallow& shallow() const { return shallow_; }
    // Of a body a with contact (a, b): the diameter that penetration is compared with [m].
    static double diameter(const Contact& contact, const Bodies& bodies);
    std::size_t bytes() const;

  private:
    void widen(const Bodies& bodies);
    void add_shallow(double depth, double diameter);
    void measure_gaps(const Scene& scene, const State& state, const CandidateList& candidates);
    void collect(const Scene& scene, const State& state, const CandidateList& candidates);

    std::vector<double> push_, wider_;  // [m] d_i, n
    std::vector<double> gap_;           // [m] of each pair of the list, in its order
    struct NearPair {
        std::uint32_t a, b;  // a < b
        double gap;          // [m]
    };
    std::vector<NearPair> near_;  // those that the deepest push could close, in order
    ContactSet contacts_;
    Shallow shallow_;
};

}  // namespace scree::contact
