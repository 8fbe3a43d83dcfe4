#include "solvers/layout.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/radix_sort.hpp"

namespace scree::solvers {
namespace {

// The colour of a block by the parities of x, y (bits 0 and 1) and z. From colour to colour one parity changes, those
// of x and y only twice in a sweep: blocks on either side of a cut between ranks take turns as seldom as can be.
constexpr std::array<std::uint64_t, 8> kColour{0, 7, 3, 4, 1, 6, 2, 5};
constexpr std::uint64_t kWideBodies = ~std::uint64_t{0};  // the block of those that fit into no block

// The k-th of all positive numbers in increasing order, over all ranks: their bits order as they do.
double kth_of_all(const std::vector<double>& own, std::uint64_t k, const Communicator& ranks) {
    std::uint64_t prefix = 0;
    for (int shift = 48; shift >= 0; shift -= 16) {
        std::vector<std::uint64_t> count(1U << 16, 0);
        for (const double x : own) {
            const auto bits = std::bit_cast<std::uint64_t>(x);
            if (shift == 48 || bits >> (shift + 16) == prefix) ++count[bits >> shift & 0xffff];
        }
        ranks.sum(count);
        std::uint64_t digit = 0;
        while (k >= count[digit]) k -= count[digit++];
        prefix = prefix << 16 | digit;
    }
    return std::bit_cast<double>(prefix);
}

}  // namespace

double choose_block_size(const Bodies& bodies, const Communicator& ranks) {
    std::vector<double> own;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!bodies.is_ghost(i)) own.push_back(bodies.radius[i]);
    const std::uint64_t n = ranks.sum(static_cast<std::uint64_t>(own.size()));
    if (n == 0) return 0.0;
    const double median = 2.0 * kth_of_all(own, n / 2, ranks);
    const double widest = 2.0 * ranks.max(own.empty() ? 0.0 : *std::max_element(own.begin(), own.end()));
    return std::min(std::max(5.0 * median, 2.2 * widest), 16.0 * median);
}

void Layout::find_homes(const contact::ContactSet& contacts, const std::vector<Vec3>& points, const Bodies& bodies,
                        double block_size) {
    home_.resize(contacts.size());
    if (points.empty())
        for (std::size_t c = 0; c < contacts.size(); ++c) home_[c] = contact::home_of(contacts[c], bodies, block_size);
    else
        for (std::size_t c = 0; c < contacts.size(); ++c)
            home_[c] = contact::home_of(contacts[c], points[c], bodies, block_size);
}

void Layout::place(const contact::ContactSet& contacts) {
    constexpr std::int32_t kLarge = 2 * kMostBlocks;
    std::array<std::int32_t, 3> low{kLarge, kLarge, kLarge}, high{-kLarge, -kLarge, -kLarge};
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        for (std::size_t d = 0; d < 3; ++d) {
            low[d] = std::min(low[d], home_[c].block[d]);
            high[d] = std::max(high[d], home_[c].block[d]);
        }
    }
    // keys as short as the scene allows; even offsets keep the parity, so that the order is that of absolute indices
    std::array<int, 3> bits{};
    for (std::size_t d = 0; d < 3; ++d) {
        low[d] &= ~std::int32_t{1};
        bits[d] = static_cast<int>(std::bit_width(static_cast<std::uint32_t>(high[d] - low[d])));
    }
    colour_shift_ = bits[0] + bits[1] + bits[2];
    placed_.clear();
    for (std::uint32_t c = 0; c < contacts.size(); ++c) {
        const auto x = static_cast<std::uint64_t>(home_[c].block[0] - low[0]),
                   y = static_cast<std::uint64_t>(home_[c].block[1] - low[1]),
                   z = static_cast<std::uint64_t>(home_[c].block[2] - low[2]);
        const std::uint64_t colour = kColour[(x & 1) | (y & 1) << 1 | (z & 1) << 2];
        const std::uint64_t key = (((colour << bits[2] | z) << bits[1] | y) << bits[0]) | x;
        placed_.push_back({home_[c].wide ? kWideBodies : key, c});
    }
}

void Layout::fill_block(const contact::ContactSet& contacts, std::size_t begin, std::size_t end) {
    const auto first = static_cast<std::uint32_t>(lane_.size());
    if (++stamp_ == 0) {  // wrapped: old stamps must not look new
        occupied_.assign(occupied_.size(), {});
        stamp_ = 1;
    }
    std::uint32_t base = first;           // batches before this one are full
    std::uint64_t full = 0;               // of the 64 from base on
    std::array<std::uint8_t, 64> used{};  // lanes of batch k at k mod 64
    const auto occupied_by = [&](std::uint32_t body) -> Occupied& {
        Occupied& o = occupied_[body];
        if (o.stamp != stamp_) o = {0, base, stamp_};
        const std::uint32_t moved = base - o.base;
        o.batches = moved >= 64 ? 0 : o.batches >> moved;
        o.base = base;
        return o;
    };
    const auto advance = [&](int by) {
        full = by >= 64 ? 0 : full >> by;
        for (int k = 0; k < by; ++k) used[base++ % 64] = 0;
    };
    for (std::size_t k = begin; k < end; ++k) {
        const contact::Contact& contact = contacts[placed_[k].contact];
        const bool wall = contact.key.is_wall();
        for (;;) {
            Occupied& a = occupied_by(contact.a);
            const std::uint64_t taken = full | a.batches | (wall ? 0 : occupied_by(contact.b).batches);
            if (~taken == 0) {  // a body with very many contacts: leave the oldest batch as it is
                advance(1);
                continue;
            }
            const int slot = std::countr_zero(~taken);
            const std::uint64_t bit = std::uint64_t{1} << slot;
            const std::size_t batch = base + static_cast<std::uint32_t>(slot);
            if (batch >= lane_.size()) {
                lane_.emplace_back();
                lane_.back().fill(kNoContact);
            }
            auto& count = used[batch % 64];
            lane_[batch][count++] = placed_[k].contact;
            a.batches |= bit;
            if (!wall) occupied_[contact.b].batches |= bit;
            if (count == kLanes) full |= bit;
            const int done = std::countr_one(full);
            if (done > 0) advance(done);
            break;
        }
    }
    blocks_.push_back({first, static_cast<std::uint32_t>(lane_.size())});
}

void Layout::assign_lines(const contact::ContactSet& contacts, std::size_t bodies) {
    body_line_.assign(bodies, kGround);
    std::uint32_t next = kGround + 1;
    const auto visit = [&](std::uint32_t body) {
        if (body_line_[body] == kGround) body_line_[body] = next++;
    };
    for (const auto& lanes : lane_)
        for (const std::uint32_t c : lanes) {
            if (c == kNoContact) continue;
            visit(contacts[c].a);
            if (!contacts[c].key.is_wall()) visit(contacts[c].b);
        }
    touched_ = next - 1;
    for (std::uint32_t body = 0; body < bodies; ++body) visit(body);
}

// Blocks that touch shared bodies first: their results travel while the others are solved.
void Layout::sort_phase(PhaseBlocks& phase, const contact::ContactSet& contacts,
                        const std::vector<std::uint8_t>& shared) {
    phase.inner = phase.begin;
    if (shared.empty()) return;
    inner_.clear();
    for (std::uint32_t k = phase.begin; k < phase.end; ++k) {
        const Block block = blocks_[k];
        const bool border = std::any_of(lane_.begin() + block.begin, lane_.begin() + block.end, [&](const auto& lanes) {
            return std::any_of(lanes.begin(), lanes.end(), [&](std::uint32_t c) {
                return c != kNoContact &&
                       (shared[contacts[c].a] != 0 || (!contacts[c].key.is_wall() && shared[contacts[c].b] != 0));
            });
        });
        if (border)
            blocks_[phase.inner++] = block;
        else
            inner_.push_back(block);
    }
    std::copy(inner_.begin(), inner_.end(), blocks_.begin() + phase.inner);
}

void Layout::arrange(const contact::ContactSet& contacts, const Bodies& bodies, double block_size,
                     const std::vector<std::uint8_t>& shared, const std::vector<Vec3>& points) {
    blocks_.clear();
    lane_.clear();
    home_.clear();
    phase_.fill({});
    if (!contacts.empty()) {
        find_homes(contacts, points, bodies, block_size);
        place(contacts);
        // stable: contacts of a block stay in order of key
        radix_sort(placed_, sorted_, [](const Placed& p) { return p.block; });
        occupied_.resize(bodies.size());
        for (std::size_t begin = 0; begin < placed_.size();) {
            std::size_t end = begin;
            while (end < placed_.size() && placed_[end].block == placed_[begin].block) ++end;
            fill_block(contacts, begin, end);
            const std::uint64_t key = placed_[begin].block;
            PhaseBlocks& phase = phase_[key == kWideBodies ? kPhases - 1 : key >> colour_shift_];
            const auto count = static_cast<std::uint32_t>(blocks_.size());
            if (phase.end == 0) phase.begin = count - 1;
            phase.end = count;
            begin = end;
        }
        for (PhaseBlocks& phase : phase_) sort_phase(phase, contacts, shared);
    }
    assign_lines(contacts, bodies.size());
}

std::size_t Layout::bytes() const {
    return (placed_.capacity() + sorted_.capacity()) * sizeof(Placed) +
           home_.capacity() * sizeof(contact::ContactHome) + (blocks_.capacity() + inner_.capacity()) * sizeof(Block) +
           body_line_.capacity() * 4 + lane_.capacity() * sizeof(lane_[0]) + occupied_.capacity() * sizeof(Occupied);
}

}  // namespace scree::solvers
