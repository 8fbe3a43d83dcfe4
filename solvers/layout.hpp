// The order of work of Gauss-Seidel, which depends on positions and ids alone:
//   space is cut into cubic blocks of edge L; a contact belongs to the block that holds its contact point; blocks have
//   one of 8 colours by the parity of their indices. Two blocks of a colour lie at least L apart, so that no body of
//   diameter below L has contacts in both: the blocks of a colour may be done in any order.
//   Within a block, contacts in order of key go into batches of eight that share no moving body (first fit).
// Contacts of moving bodies too wide for a block come last, in order of key, as one more block.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "contact/contact_set.hpp"
#include "core/bodies.hpp"
#include "core/simd.hpp"
#include "solvers/batch.hpp"

namespace scree::solvers {

inline constexpr std::uint32_t kNoContact = 0xffffffffU;

// Edge of the blocks for these bodies: about four diameters of the middle body, wide enough for almost all of them.
double choose_block_size(const std::vector<double>& radius);

class Layout {
  public:
    // Blocks and lanes for `contacts` (in order of key).
    void arrange(const contact::ContactSet& contacts, const Bodies& bodies, double block_size);

    const std::vector<Block>& blocks() const { return blocks_; }
    std::size_t batches() const { return lane_.size(); }
    // Contact of each lane of each batch, or kNoContact.
    const std::vector<std::array<std::uint32_t, kLanes>>& lanes() const { return lane_; }
    // The line of each body: lines lie in the order in which the batches first come to their bodies, so that a sweep
    // walks through memory as it walks through space. Bodies without a contact come last; line 0 is the ground.
    std::uint32_t line(std::size_t body) const { return body_line_[body]; }
    // Lines 1 to this are those of bodies with a contact.
    std::uint32_t touched_lines() const { return touched_; }
    std::size_t bytes() const;

  private:
    struct Placed {
        std::uint64_t block;  // sorts by colour, then z, y, x
        std::uint32_t contact;
    };
    void place(const contact::ContactSet& contacts, const Bodies& bodies, double block_size);
    void fill_block(const contact::ContactSet& contacts, std::size_t begin, std::size_t end);

    struct Index {
        std::array<std::int64_t, 3> at;  // block in x, y, z
        bool wide;                       // a body too wide for a block
    };
    std::vector<Index> index_;  // one a contact
    void assign_lines(const contact::ContactSet& contacts, std::size_t bodies);

    std::vector<std::uint32_t> body_line_;  // n
    std::uint32_t touched_ = 0;
    std::vector<Placed> placed_, sorted_;
    std::vector<Block> blocks_;
    std::vector<std::array<std::uint32_t, kLanes>> lane_;
    // First fit: which of the 64 batches from `base` on hold a body; one a body, valid while `stamp` is the block's.
    struct Occupied {
        std::uint64_t batches = 0;
        std::uint32_t base = 0, stamp = 0;
    };
    std::vector<Occupied> occupied_;
    std::uint32_t stamp_ = 0;
};

}  // namespace scree::solvers
