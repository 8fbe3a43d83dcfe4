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

#include "contact/contact_home.hpp"
#include "contact/contact_set.hpp"
#include "core/bodies.hpp"
#include "core/parallel/communicator.hpp"
#include "core/simd.hpp"
#include "solvers/batch.hpp"

namespace scree::solvers {

inline constexpr std::uint32_t kNoContact = 0xffffffffU;
inline constexpr std::size_t kPhases = 9;  // of a sweep: eight colours, and the contacts of bodies wider than a block

// Edge of the blocks for these bodies: about five diameters of the middle body, wide enough for almost all of them.
// The same on every rank.
double choose_block_size(const Bodies& bodies, const Communicator& ranks = Communicator::self());

class Layout {
  public:
    // Blocks and lanes for `contacts` (in order of key). `shared`: bodies that other ranks hold too, n, or empty.
    // `points` [m]: of the contacts, empty where bodies are spheres.
    void arrange(const contact::ContactSet& contacts, const Bodies& bodies, double block_size,
                 const std::vector<std::uint8_t>& shared = {}, const std::vector<Vec3>& points = {});

    const std::vector<Block>& blocks() const { return blocks_; }
    // Blocks of a phase: those before `inner` touch shared bodies and are done first.
    struct PhaseBlocks {
        std::uint32_t begin = 0, inner = 0, end = 0;
    };
    const PhaseBlocks& phase(std::size_t k) const { return phase_[k]; }
    std::size_t batches() const { return lane_.size(); }
    // Contact of each lane of each batch, or kNoContact.
    const std::vector<std::array<std::uint32_t, kLanes>>& lanes() const { return lane_; }
    // The line of each body: lines lie in the order in which the batches first come to their bodies, so that a sweep
    // walks through memory as it walks through space. Bodies without a contact come last; line 0 is the ground.
    std::uint32_t line(std::size_t body) const { return body_line_[body]; }
    // Where each contact is solved.
    const std::vector<contact::ContactHome>& homes() const { return home_; }
    // Lines 1 to this are those of bodies with a contact.
    std::uint32_t touched_lines() const { return touched_; }
    std::size_t bytes() const;

  private:
    struct Placed {
        std::uint64_t block;  // sorts by colour, then z, y, x
        std::uint32_t contact;
    };
    void find_homes(const contact::ContactSet& contacts, const std::vector<Vec3>& points, const Bodies& bodies,
                    double block_size);
    void place(const contact::ContactSet& contacts);
    void fill_block(const contact::ContactSet& contacts, std::size_t begin, std::size_t end);

    std::vector<contact::ContactHome> home_;  // one a contact
    void assign_lines(const contact::ContactSet& contacts, std::size_t bodies);
    void sort_phase(PhaseBlocks& phase, const contact::ContactSet& contacts, const std::vector<std::uint8_t>& shared);

    std::vector<std::uint32_t> body_line_;  // n
    std::uint32_t touched_ = 0;
    std::vector<Placed> placed_, sorted_;
    std::vector<Block> blocks_, inner_;
    std::array<PhaseBlocks, kPhases> phase_;
    int colour_shift_ = 0;  // of a block's key
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
