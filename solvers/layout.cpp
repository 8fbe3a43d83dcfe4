#include "solvers/layout.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/radix_sort.hpp"

namespace scree::solvers {
namespace {

constexpr std::uint64_t kWideBodies = ~std::uint64_t{0};  // the block of those that fit into no block
constexpr int kIndexBits = 20;                            // of a block's index in each direction
constexpr std::int64_t kIndexHalf = std::int64_t{1} << (kIndexBits - 1);

// Index of the block that holds x. Far out indices wrap: that only mixes far away blocks, whose bodies are then told
// apart by the batches of first fit.
std::uint64_t block_index(double x, double size) {
    const auto i = static_cast<std::int64_t>(std::floor(x / size)) + kIndexHalf;
    return static_cast<std::uint64_t>(i) & ((std::uint64_t{1} << kIndexBits) - 1);
}

std::uint64_t block_key(const Vec3& point, double size) {
    const std::uint64_t x = block_index(point.x(), size), y = block_index(point.y(), size),
                        z = block_index(point.z(), size);
    const std::uint64_t colour = (x & 1) | (y & 1) << 1 | (z & 1) << 2;
    return (((colour << kIndexBits | z) << kIndexBits | y) << kIndexBits) | x;
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
    placed_.clear();
    for (std::uint32_t c = 0; c < contacts.size(); ++c) {
        const contact::Contact& contact = contacts[c];
        const double ra = bodies.radius[contact.a];
        const double widest = contact.key.is_wall() ? ra : std::max(ra, bodies.radius[contact.b]);
        const bool wide = 2.0 * widest + std::abs(contact.gap) >= block_size;
        placed_.push_back(
            {wide ? kWideBodies : block_key(contact.point(bodies.position[contact.a], ra), block_size), c});
    }
}

void Layout::fill_block(const contact::ContactSet& contacts, std::size_t begin, std::size_t end) {
    const auto first = static_cast<std::uint32_t>(lane_.size());
    if (++stamp_ == 0) {  // wrapped: old stamps must not look new
        occupied_.assign(occupied_.size(), {});
        stamp_ = 1;
    }
    std::uint32_t base = first;  // batches before this one are full
    std::uint64_t full = 0;      // of the 64 from base on
    std::array<std::uint8_t, 64> used{};
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
        for (int k = 0; k < 64; ++k)
            used[static_cast<std::size_t>(k)] = k + by < 64 ? used[static_cast<std::size_t>(k + by)] : std::uint8_t{0};
        base += static_cast<std::uint32_t>(by);
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
            auto& count = used[static_cast<std::size_t>(slot)];
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

void Layout::arrange(const contact::ContactSet& contacts, const Bodies& bodies, double block_size) {
    blocks_.clear();
    lane_.clear();
    if (contacts.empty()) return;
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

std::size_t Layout::bytes() const {
    return (placed_.capacity() + sorted_.capacity()) * sizeof(Placed) + blocks_.capacity() * sizeof(Block) +
           lane_.capacity() * sizeof(lane_[0]) + occupied_.capacity() * sizeof(Occupied);
}

}  // namespace scree::solvers
