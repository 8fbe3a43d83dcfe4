// Rows that lie on ranks in any way, brought to slices of their global order by key: rank r gets the rows
// first(r) <= row < first(r + 1) of that order. No rank sees the keys of all: the key at each border is found bit by
// bit, by counting on every rank the keys below a candidate (one sum over ranks a bit; a few dozen in all).
#pragma once

#include <cstdint>
#include <cstring>
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
        std::vector<T> came = deliver<T>([&](const Row& row) -> const T& { return values[row.index]; });
        if (ranks_.alone()) return came;
        std::vector<T> sorted;
        sorted.reserve(came.size());
        for (const std::size_t k : order_) sorted.push_back(came[k]);
        return sorted;
    }

  private:
    // One value a row of this rank's slice, as they come: by the rank that sent them, then by key. `of`: Row to value.
    template <class T, class Of>
    std::vector<T> deliver(const Of& of) const {
        std::vector<T> came;
        if (ranks_.alone()) {
            came.reserve(rows_.size());
            for (const Row& row : rows_) came.push_back(of(row));
            return came;
        }
        std::vector<Communicator::Message> messages;
        for (std::size_t r = 0; r + 1 < cuts_.size(); ++r) {
            if (cuts_[r] == cuts_[r + 1]) continue;
            messages.push_back({static_cast<int>(r), std::vector<std::byte>((cuts_[r + 1] - cuts_[r]) * sizeof(T))});
            std::byte* to = messages.back().bytes.data();
            for (std::size_t k = cuts_[r]; k < cuts_[r + 1]; ++k, to += sizeof(T)) {
                std::memcpy(to, static_cast<const void*>(&of(rows_[k])), sizeof(T));
            }
        }
        messages = ranks_.exchange(messages);
        std::size_t bytes = 0;
        for (const Communicator::Message& message : messages) bytes += message.bytes.size();
        came.resize(bytes / sizeof(T));
        auto* to = reinterpret_cast<std::byte*>(came.data());
        for (const Communicator::Message& message : messages) {
            std::memcpy(to, message.bytes.data(), message.bytes.size());
            to += message.bytes.size();
        }
        return came;
    }

    Communicator ranks_;
    Division division_;
    std::vector<Row> rows_;           // of this rank, sorted by key
    std::vector<std::size_t> cuts_;   // rows_[cuts_[r]] ... go to rank r; ranks + 1 of them
    std::vector<std::size_t> order_;  // of the rows that came: which comes k-th by key
};

// Own bodies (no ghosts), by id.
struct BodySlice {
    Bodies bodies;
    Bodies::Arrays arrays;  // equal on all ranks, those without bodies too
};
BodySlice slice_bodies(const Bodies& bodies, std::uint64_t granule, const Communicator& ranks);
// `own`: disjoint over ranks.
WarmStart slice_warm_start(const WarmStart& own, const Communicator& ranks);
std::vector<ContactRecord> slice_contacts(const std::vector<ContactRecord>& own, std::uint64_t granule,
                                          const Communicator& ranks);

}  // namespace scree
