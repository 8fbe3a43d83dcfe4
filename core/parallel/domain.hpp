// The part of a scene that one rank works on: the partition of space, the halo, and when they are made anew. With one
// rank it does nothing.
#pragma once

#include <functional>
#include <vector>

#include "core/parallel/communicator.hpp"
#include "core/parallel/halo.hpp"
#include "core/parallel/partition.hpp"
#include "core/state.hpp"

namespace scree {

class Domain {
  public:
    explicit Domain(const Communicator& ranks = Communicator::self()) : ranks_(ranks), halo_(ranks) {}

    const Communicator& ranks() const { return ranks_; }
    bool alone() const { return ranks_.alone(); }
    Halo& halo() { return halo_; }
    const Halo& halo() const { return halo_; }
    const Partition& partition() const { return partition_; }

    // Whether other ranks hold all of this rank's bodies that may touch their blocks while they stay within their
    // margins [m] (one a body). Not collective.
    bool covers(const State& state, const std::vector<double>& margin) { return halo_.holds(state, margin); }
    // Makes it so on all ranks; indices of bodies change. Bodies keep their owners. Collective.
    void extend(State& state, const std::vector<double>& margin, double step) {
        halo_.rebuild(partition_, {state.block_size, step, false}, margin, state);
    }
    // The same, and bodies go to the owners of their blocks.
    void settle(State& state, const std::vector<double>& margin, double step) {
        halo_.rebuild(partition_, {state.block_size, step, true}, margin, state);
    }
    // Cuts space anew if the largest share of a rank in the work is too far above the mean and another cut is better;
    // true if so: settle() is due. `add_work` adds the work of this rank's blocks in the last step. Collective.
    using AddWork = std::function<void(std::vector<BlockWork>&)>;
    bool balance(const State& state, const AddWork& add_work);
    // Before the first step: bodies lie on any ranks.
    void start(State& state, const std::vector<double>& margin, double step);
    // Blocks have another size: partition and halo mean nothing until start() is called again.
    void forget() { started_ = false; }
    bool started() const { return alone() || started_; }

    std::uint64_t repartitions() const { return repartitions_; }
    double imbalance() const { return imbalance_; }  // largest work of a rank over the mean, when last looked at

  private:
    const Communicator& ranks_;
    Partition partition_;
    Halo halo_;
    bool started_ = false;
    std::uint64_t repartitions_ = 0;
    double imbalance_ = 1.0;
};

}  // namespace scree
