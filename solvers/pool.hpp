// Sums and maxima over all ranks, many at once: one reduction for all sums of a step and one for all maxima. What
// follows is read back in the order in which it was asked for.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/exact_sum.hpp"
#include "core/parallel/communicator.hpp"

namespace scree::solvers {

class Pool {
  public:
    void clear() {
        sum_.clear();
        most_.clear();
        total_.clear();
        read_sums_ = read_most_ = 0;
    }
    // Room for n more, to be filled before the next call; exact sums from 0, maxima from -infinity.
    std::span<ExactSum> sums(std::size_t n) {
        sum_.resize(sum_.size() + n);
        return std::span(sum_).last(n);
    }
    std::span<double> most(std::size_t n) {
        most_.resize(most_.size() + n, -std::numeric_limits<double>::infinity());
        return std::span(most_).last(n);
    }
    // Collective: every rank has asked for the same.
    void unite(const Communicator& ranks) {
        if (!sum_.empty()) ranks.sum(std::span<ExactSum>(sum_));
        if (!most_.empty()) ranks.max(std::span<double>(most_));
        for (const ExactSum& sum : sum_) total_.push_back(sum.value());
    }
    std::span<const double> next_sums(std::size_t n) {
        read_sums_ += n;
        return std::span(total_).subspan(read_sums_ - n, n);
    }
    std::span<const double> next_most(std::size_t n) {
        read_most_ += n;
        return std::span(most_).subspan(read_most_ - n, n);
    }

  private:
    std::vector<ExactSum> sum_;
    std::vector<double> most_, total_;
    std::size_t read_sums_ = 0, read_most_ = 0;
};

}  // namespace scree::solvers
