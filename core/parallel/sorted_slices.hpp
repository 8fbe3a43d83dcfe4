// Rows that lie on ranks in any way, brought to slices of their global order by key: rank r gets the rows
// first(r) <= row < first(r + 1) of that order. No rank sees the keys of all: the key at each border is found bit by
// bit, by counting on every rank the keys below a candidate (one sum over ranks a bit; a few dozen in all).
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <vector>

#include "core/bodies.hpp"
#include "core/contact_record.hpp"
#include "core/ids.hpp"
#include "core/parallel/communicator.hpp"
#include "core/state.hpp"

namespace scree {

// An even division of rows over ranks.
struct Division {
    std::uint64_t total = 0;
    std::uint64_t granule = 1;  // slices begin at multiples of it
    int ranks = 1;

    std::uint64_t first(int rank) const;  // total for rank == ranks
};

class SortedSlices {
  public:
    struct Row {
        ContactKey key;         // of a body: {id, 0, 0}
        std::size_t index = 0;  // where the row is in the caller's arrays
    };
    // Collective. Keys are all different.
    SortedSlices(std::vector<Row> rows, std::uint64_t granule, const Communicator& ranks);

    // This rank's slice.
    std::uint64_t begin() const { return division_.first(ranks_.rank()); }
    std::uint64_t end() const { return division_.first(ranks_.rank() + 1); }
    std::uint64_t total() const { return division_.total; }

    // Collective. `values`: one a row, found by Row::index. Returns those of this rank's slice in order of key.
    template <class T>
    std::vector<T> move(const std::vector<T>& values) const {
        const std::vector<std::byte> bytes = move(reinterpret_cast<const std::byte*>(values.data()), sizeof(T));
        std::vector<T> moved(bytes.size() / sizeof(T));
        if (!bytes.empty()) std::memcpy(static_cast<void*>(moved.data()), bytes.data(), bytes.size());
        return moved;
    }

  private:
    using Place = std::function<const void*(const Row&)>;
    std::vector<std::byte> deliver(std::size_t width, const Place& place) const;
    std::vector<std::byte> move(const std::byte* values, std::size_t width) const;

    Communicator ranks_;
    Division division_;
    std::vector<Row> rows_;           // of this rank, sorted by key
    std::vector<std::size_t> cuts_;   // rows_[cuts_[r]] ... go to rank r; ranks + 1 of them
    std::vector<std::size_t> order_;  // of the rows that came: which comes k-th by key
};

// Own bodies (no ghosts), by id.
struct BodySlice {
    Bodies bodies;
    bool spins = false, orientations = false;  // equal on all ranks, those without bodies too
};
BodySlice slice_bodies(const Bodies& bodies, std::uint64_t granule, const Communicator& ranks);
// `own`: disjoint over ranks.
WarmStart slice_warm_start(const WarmStart& own, const Communicator& ranks);
std::vector<ContactRecord> slice_contacts(const std::vector<ContactRecord>& own, std::uint64_t granule,
                                          const Communicator& ranks);

}  // namespace scree
