#include "core/parallel/domain.hpp"

#include <algorithm>
#include <numeric>

namespace scree {
namespace {

constexpr double kMostImbalance = 1.05;  // above it, space is cut anew
constexpr double kLeastGain = 0.02;      // if that promises to help by this much

// Share of each rank in the work under a partition; the largest over the mean.
double imbalance_of(const Communicator& ranks, const Partition& partition, const std::vector<BlockWork>& work) {
    std::vector<std::uint64_t> load(static_cast<std::size_t>(ranks.size()), 0);
    for (const BlockWork& b : work) load[static_cast<std::size_t>(partition.owner(b.block))] += b.work;
    ranks.sum(load);
    const std::uint64_t total = std::accumulate(load.begin(), load.end(), std::uint64_t{0});
    if (total == 0) return 1.0;
    return static_cast<double>(*std::max_element(load.begin(), load.end())) * ranks.size() / static_cast<double>(total);
}

}  // namespace

void Domain::start(State& state, const std::vector<double>& margin, double step) {
    if (started()) return;
    started_ = true;
    std::vector<BlockWork> work;
    for (std::size_t i = 0; i < state.bodies.size(); ++i)
        if (!state.bodies.is_ghost(i)) work.push_back({block_of(state.bodies.position[i], state.block_size), 1});
    partition_ = Partition::bisect(ranks_, work);
    halo_.rebuild(partition_, {state.block_size, step, true}, margin, state);
}

bool Domain::balance(const State& state, const AddWork& add_work) {
    if (alone()) return false;
    std::vector<BlockWork> all;
    add_work(all);
    for (std::size_t i = 0; i < state.bodies.size(); ++i)
        if (!state.bodies.is_ghost(i)) all.push_back({block_of(state.bodies.position[i], state.block_size), 1});
    imbalance_ = imbalance_of(ranks_, partition_, all);
    if (imbalance_ <= kMostImbalance) return false;
    const Partition better = Partition::bisect(ranks_, all);
    const double then = imbalance_of(ranks_, better, all);
    if (then > imbalance_ - kLeastGain || better == partition_) return false;
    partition_ = better;
    imbalance_ = then;
    ++repartitions_;
    return true;
}

}  // namespace scree
