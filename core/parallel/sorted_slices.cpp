#include "core/parallel/sorted_slices.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "core/errors.hpp"
#include "core/parallel/body_message.hpp"

namespace scree {
namespace {

// One bit of a key.
struct Bit {
    std::uint64_t a = 0, b = 0;
    std::uint32_t feature = 0;
};

// The bits in which keys can differ, from the first that counts in their order to the last.
std::vector<Bit> bits_in_use(const std::vector<SortedSlices::Row>& rows, const Communicator& ranks) {
    std::array<std::uint64_t, 4> largest{};
    for (const SortedSlices::Row& row : rows) {
        largest[0] = std::max(largest[0], row.key.a);
        largest[1] = std::max<std::uint64_t>(largest[1], row.key.is_wall() ? 1 : 0);
        largest[2] = std::max(largest[2], row.key.b & ~ContactKey::kWallBit);
        largest[3] = std::max<std::uint64_t>(largest[3], row.key.feature);
    }
    ranks.max(std::span(largest));
    std::vector<Bit> bits;
    for (int k = static_cast<int>(std::bit_width(largest[0])); k-- > 0;) bits.push_back({std::uint64_t{1} << k, 0, 0});
    if (largest[1] != 0) bits.push_back({0, ContactKey::kWallBit, 0});
    for (int k = static_cast<int>(std::bit_width(largest[2])); k-- > 0;) bits.push_back({0, std::uint64_t{1} << k, 0});
    for (int k = static_cast<int>(std::bit_width(largest[3])); k-- > 0;) bits.push_back({0, 0, std::uint32_t{1} << k});
    return bits;
}

std::size_t count_below(const std::vector<SortedSlices::Row>& rows, const ContactKey& key) {
    const auto at = std::lower_bound(rows.begin(), rows.end(), key,
                                     [](const SortedSlices::Row& row, const ContactKey& k) { return row.key < k; });
    return static_cast<std::size_t>(at - rows.begin());
}

// The first local row of each rank's slice. The border before rank r is the largest key below which there are no
// more than first(r) keys: that of row first(r).
std::vector<std::size_t> find_cuts(const std::vector<SortedSlices::Row>& rows, const Division& division,
                                   const Communicator& ranks) {
    const auto size = static_cast<std::size_t>(ranks.size());
    std::vector<ContactKey> border(size);
    std::vector<std::uint64_t> below(size);
    for (const Bit& bit : bits_in_use(rows, ranks)) {
        const auto with = [&](const ContactKey& k) {
            return ContactKey{k.a | bit.a, k.b | bit.b, k.feature | bit.feature};
        };
        for (std::size_t r = 0; r < size; ++r) below[r] = count_below(rows, with(border[r]));
        ranks.sum(std::span(below));
        for (std::size_t r = 0; r < size; ++r) {
            if (below[r] <= division.first(static_cast<int>(r))) border[r] = with(border[r]);
        }
    }
    std::vector<std::size_t> cuts(size + 1, rows.size());
    for (std::size_t r = 0; r < size; ++r) {
        const std::uint64_t first = division.first(static_cast<int>(r));
        if (first < division.total) cuts[r] = count_below(rows, border[r]);
    }
    cuts[0] = 0;
    return cuts;
}

// Indices that sort `keys`, which are a few increasing runs one after another: these are merged, two by two.
std::vector<std::size_t> merging_order(const std::vector<ContactKey>& keys) {
    std::vector<std::size_t> order(keys.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<std::size_t> starts = {0};
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (keys[i] < keys[i - 1]) starts.push_back(i);
    starts.push_back(keys.size());
    const auto less = [&](std::size_t i, std::size_t j) { return keys[i] < keys[j]; };
    const auto at = [&](std::size_t run) { return order.begin() + static_cast<std::ptrdiff_t>(starts[run]); };
    while (starts.size() > 2) {
        std::vector<std::size_t> left;
        for (std::size_t run = 0; run + 1 < starts.size(); run += 2) {
            left.push_back(starts[run]);
            if (run + 2 < starts.size()) std::inplace_merge(at(run), at(run + 1), at(run + 2), less);
        }
        left.push_back(keys.size());
        starts = std::move(left);
    }
    return order;
}

}  // namespace

std::uint64_t Division::first(int rank) const {
    const std::uint64_t granules = (total + granule - 1) / granule;
    const auto r = static_cast<std::uint64_t>(rank), size = static_cast<std::uint64_t>(ranks);
    // granules * r / size without overflow
    const std::uint64_t before = granules / size * r + granules % size * r / size;
    return std::min(total, before * granule);
}

SortedSlices::SortedSlices(std::vector<Row> rows, std::uint64_t granule, const Communicator& ranks)
    : ranks_(ranks), division_{ranks.sum(rows.size()), granule, ranks.size()}, rows_(std::move(rows)) {
    const auto by_key = [](const Row& x, const Row& y) { return x.key < y.key; };
    if (!std::is_sorted(rows_.begin(), rows_.end(), by_key)) std::sort(rows_.begin(), rows_.end(), by_key);
    cuts_ = ranks_.alone() ? std::vector<std::size_t>{0, rows_.size()} : find_cuts(rows_, division_, ranks_);
    if (ranks_.alone()) return;
    const auto came = deliver<ContactKey>([](const Row& row) -> const ContactKey& { return row.key; });
    SCREE_CHECK(ranks_.all(came.size() == end() - begin()));  // or two rows have one key
    order_ = merging_order(came);
}

BodySlice slice_bodies(const Bodies& bodies, std::uint64_t granule, const Communicator& ranks) {
    std::vector<SortedSlices::Row> rows;
    rows.reserve(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!bodies.is_ghost(i)) rows.push_back({{raw(bodies.id[i]), 0, 0}, i});
    BodySlice slice;
    slice.arrays = arrays_of_all(bodies, ranks);
    const SortedSlices slices(std::move(rows), granule, ranks);
    Bodies& own = slice.bodies;
    own.id = slices.move(bodies.id);
    own.radius = slices.move(bodies.radius);
    own.mass = slices.move(bodies.mass);
    own.material = slices.move(bodies.material);
    own.position = slices.move(bodies.position);
    own.velocity = slices.move(bodies.velocity);
    if (slice.arrays.spin) own.spin = slices.move(bodies.spin);
    if (slice.arrays.orientation) own.orientation = slices.move(bodies.orientation);
    if (slice.arrays.shape) {
        own.shape = slices.move(bodies.shape);
        own.inertia = slices.move(bodies.inertia);
    }
    return slice;
}

WarmStart slice_warm_start(const WarmStart& own, const Communicator& ranks) {
    std::vector<SortedSlices::Row> rows(own.key.size());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = {own.key[i], i};
    const SortedSlices slices(std::move(rows), 1, ranks);
    WarmStart slice;
    slice.step = own.step;
    slice.key = slices.move(own.key);
    if (ranks.any(!own.impulse_vector.empty())) slice.impulse_vector = slices.move(own.impulse_vector);
    if (ranks.any(!own.impulse_normal.empty())) slice.impulse_normal = slices.move(own.impulse_normal);
    return slice;
}

std::vector<ContactRecord> slice_contacts(const std::vector<ContactRecord>& own, std::uint64_t granule,
                                          const Communicator& ranks) {
    std::vector<SortedSlices::Row> rows(own.size());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = {own[i].key, i};
    return SortedSlices(std::move(rows), granule, ranks).move(own);
}

}  // namespace scree
