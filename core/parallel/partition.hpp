// Which rank owns which block: recursive coordinate bisection (Berger and Bokhari 1987) of blocks weighted by their
// work. Each cut takes the direction and the plane with the least
//   larger share of the work / its share of the ranks  +  kBorder * work beside the plane,
// so that cuts follow what is there, not the container. Cuts are planes between blocks: every block has one owner by
// arithmetic on integers, and a rank's part is a box. Nothing that is computed depends on the partition.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel/blocks.hpp"
#include "core/parallel/communicator.hpp"

namespace scree {

struct BlockWork {
    BlockIndex block;
    std::uint64_t work;
};

class Partition {
  public:
    // All space belongs to rank 0.
    Partition() = default;
    // Collective: `work` is this rank's share; blocks may be named more than once and by several ranks.
    static Partition bisect(const Communicator& ranks, std::span<const BlockWork> work) {
        return bisect(ranks, work, ranks.size());
    }
    // The same for another number of parts than there are ranks.
    static Partition bisect(const Communicator& ranks, std::span<const BlockWork> work, int parts);

    int owner(const BlockIndex& block) const;
    // Appends the ranks that own a block with low <= block <= high, increasing.
    void owners(const BlockIndex& low, const BlockIndex& high, std::vector<int>& ranks) const;
    bool operator==(const Partition&) const = default;

  private:
    struct Cut {
        int direction;    // 0, 1, 2; -1: a leaf
        std::int32_t at;  // blocks with an index below go left
        int left, right;  // cuts; of a leaf: left is its rank
        bool operator==(const Cut&) const = default;
    };
    std::vector<Cut> cut_{{-1, 0, 0, 0}};
};

}  // namespace scree
