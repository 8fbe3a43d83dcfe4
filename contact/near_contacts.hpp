// What the correction of positions must know at the end of a step: the overlaps, and the neighbours into which it may
// push the overlapping bodies.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/candidate_list.hpp"
#include "contact/contact_set.hpp"
#include "core/parallel/domain.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "core/step_report.hpp"

namespace scree::contact {

// Depths of overlaps, added as integers of 2^-40 of a block: no order and no split over ranks changes a bit.
class OverlapSums {
  public:
    explicit OverlapSums(double block_size = 1.0)
        : unit_(std::ldexp(1.0, std::ilogb(block_size) - 40)), per_unit_(1.0 / unit_) {}
    void add(double depth, double diameter) {
        if (depth <= 0.0) return;
        ++count_;
        sum_ += std::llrint(depth * per_unit_);
        relative_ += std::llrint(depth / diameter * kPerOne);
        max_ = std::max(max_, depth);
        max_relative_ = std::max(max_relative_, depth / diameter);
    }
    // Of all ranks; `closed`: contacts of this rank that carried an impulse, over which means are taken.
    Penetration over(const Communicator& ranks, std::size_t closed) const {
        std::uint64_t sums[4] = {count_, static_cast<std::uint64_t>(sum_), static_cast<std::uint64_t>(relative_),
                                 closed};
        double most[2] = {max_, max_relative_};
        ranks.sum(std::span<std::uint64_t>(sums));
        ranks.max(std::span<double>(most));
        const auto count = static_cast<double>(std::max<std::uint64_t>({sums[0], sums[3], 1}));
        return {most[0], unit_ * static_cast<double>(sums[1]) / count, most[1],
                static_cast<double>(sums[2]) / kPerOne / count};
    }

  private:
    static constexpr double kPerOne = 0x1p40;
    double unit_, per_unit_;  // [m], [1/m]
    std::uint64_t count_ = 0;
    std::int64_t sum_ = 0, relative_ = 0;
    double max_ = 0.0, max_relative_ = 0.0;
};

class NearContacts {
  public:
    // Contacts in order of key, gaps exact at the end of the step; `bias` and `friction` are 0. A body may be pushed as
    // far as its deepest overlap d_i, or half as far as one of those whom it may be pushed into, a deep one to several
    // neighbours in a row; a pair is near if its gap is below d_i + d_j. Overlaps below 2e-4 of the diameter push in
    // every eighth step only; if there are no others the set is empty. On each rank those that it solves. Collective;
    // bodies may be exchanged, which changes indices.
    const ContactSet& find(const Scene& scene, State& state, double step, CandidateList& candidates, Domain& domain);
    // No rank has found a contact.
    bool none() const { return none_; }
    // The overlaps of this rank that are in no contact of the set.
    const OverlapSums& shallow() const { return shallow_; }
    // Overlaps up to this share of the diameter push nobody in this step.
    static double least_push(std::uint64_t step);
    // Of a body a with contact (a, b): the diameter that penetration is compared with [m].
    static double diameter(const Contact& contact, const Bodies& bodies);
    std::size_t bytes() const;

  private:
    double widest_push(const Bodies& bodies) const;
    void widen(const Bodies& bodies);
    void list_near(const Bodies& bodies, const CandidateList& candidates);
    void list_wide_enough(const Bodies& bodies, const CandidateList& candidates);
    void measure_gaps(const Scene& scene, const State& state, const CandidateList& candidates);
    void collect(const Scene& scene, const State& state, const CandidateList& candidates, const Domain& domain);

    std::vector<double> push_, wider_;  // [m] d_i, n
    struct NearPair {
        std::uint32_t a, b;  // a < b
        double gap;          // [m]
    };
    std::vector<NearPair> near_;  // with a gap below listed_, and all overlaps, in order
    double listed_ = 0.0;         // [m] at least twice the deepest push, once pushes are known
    double deepest_ = 0.0;        // [m] push of the last look
    ContactSet contacts_;
    bool none_ = true;
    OverlapSums shallow_;
};

}  // namespace scree::contact
