#include "solvers/layout.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/radix_sort.hpp"

namespace scree::solvers {
namespace {

constexpr std::uint64_t kWideBodies = ~std::uint64_t{0};     // the block of those that fit into no block
constexpr std::int64_t kMostBlocks = std::int64_t{1} << 20;  // in one direction

// Index of the block that holds x. Far out, indices are held at the last block: that only puts contacts that are far
// apart into one list, where first fit keeps their bodies apart.
std::int64_t block_index(double x, double size) {
    const double i = std::floor(x / size), most = static_cast<double>(kMostBlocks);
    if (!(i > -most)) return -kMostBlocks;
    return i < most ? static_cast<std::int64_t>(i) : kMostBlocks;
}

}  // namespace

double choose_block_size(const std::vector<double>& radius) {
    if (radius.empty()) return 1.0;
    std::vector<double> sorted = radius;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double median = 2.0 * *middle;
    const double widest = 2.0 * *std::max_element(radius.begin(), radius.end());
    return std::min(std::max(5.0 * median, 2.2 * widest), 16.0 * median);
}

void Layout::place(const contact::ContactSet& contacts, const Bodies& bodies, double block_size) {
    constexpr std::int64_t kLarge = 4 * kMostBlocks;
    std::array<std::int64_t, 3> low{kLarge, kLarge, kLarge}, high{-kLarge, -kLarge, -kLarge};
    index_.resize(contacts.size());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const contact::Contact& contact = contacts[c];
        const double ra = bodies.radius[contact.a];
        const Vec3 point = contact.point(bodies.position[contact.a], ra);
        const double widest = contact.key.is_wall() ? ra : std::max(ra, bodies.radius[contact.b]);
        index_[c].wide = 2.0 * widest + std::abs(contact.gap) >= block_size;
        for (std::size_t d = 0; d < 3; ++d) {
            const std::int64_t i = block_index(point[static_cast<int>(d)], block_size);
            index_[c].at[d] = i;
            low[d] = std::min(low[d], i);
            high[d] = std::max(high[d], i);
        }
    }
    // keys as short as the scene allows; even offsets keep the parity, so that the order is that of absolute indices
    std::array<int, 3> bits{};
    for (std::size_t d = 0; d < 3; ++d) {
        low[d] &= ~std::int64_t{1};
        bits[d] = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(high[d] - low[d])));
    }
    placed_.clear();
    for (std::uint32_t c = 0; c < contacts.size(); ++c) {
        const auto x = static_cast<std::uint64_t>(index_[c].at[0] - low[0]),
                   y = static_cast<std::uint64_t>(index_[c].at[1] - low[1]),
                   z = static_cast<std::uint64_t>(index_[c].at[2] - low[2]);
        const std::uint64_t colour = (x & 1) | (y & 1) << 1 | (z & 1) << 2;
        const std::uint64_t key = (((colour << bits[2] | z) << bits[1] | y) << bits[0]) | x;
        placed_.push_back({index_[c].wide ? kWideBodies : key, c});
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

void Layout::arrange(const contact::ContactSet& contacts, const Bodies& bodies, double block_size) {
    blocks_.clear();
    lane_.clear();
    if (!contacts.empty()) {
        place(contacts, bodies, block_size);
        // stable: contacts of a block stay in order of key
        radix_sort(placed_, sorted_, [](const Placed& p) { return p.block; });
        occupied_.resize(bodies.size());
        for (std::size_t begin = 0; begin < placed_.size();) {
            std::size_t end = begin;
            while (end < placed_.size() && placed_[end].block == placed_[begin].block) ++end;
            fill_block(contacts, begin, end);
            begin = end;
        }
    }
    assign_lines(contacts, bodies.size());
}

std::size_t Layout::bytes() const {
    return (placed_.capacity() + sorted_.capacity()) * sizeof(Placed) + index_.capacity() * sizeof(Index) +
           blocks_.capacity() * sizeof(Block) + body_line_.capacity() * 4 + lane_.capacity() * sizeof(lane_[0]) +
           occupied_.capacity() * sizeof(Occupied);
}

}  // namespace scree::solvers
