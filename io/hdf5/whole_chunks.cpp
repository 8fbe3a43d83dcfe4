#include "io/hdf5/whole_chunks.hpp"

#include <algorithm>
#include <cstring>
#include <span>

namespace scree::io {
namespace {

struct Interval {
    std::uint64_t begin, end;
};

// The rank that has a row.
int rank_of(std::uint64_t row, std::span<const Interval> all) {
    const auto has = std::find_if(all.begin(), all.end(),
                                  [row](const Interval& rank) { return rank.begin <= row && row < rank.end; });
    return static_cast<int>(has - all.begin());
}

}  // namespace

WholeChunks::WholeChunks(const Rows& rows, std::uint64_t begin, std::size_t chunk_rows, const Communicator& ranks)
    : rows_(rows), first_chunk_((begin + chunk_rows - 1) / chunk_rows) {
    if (!ranks.any(rows.count > 0 && begin % chunk_rows != 0)) return;
    const Interval own{begin, begin + rows.count};
    const std::vector<std::byte> bytes = ranks.all_gather(std::as_bytes(std::span(&own, 1)));
    std::vector<Interval> all(bytes.size() / sizeof(Interval));
    std::memcpy(all.data(), bytes.data(), bytes.size());

    const std::size_t row_bytes = rows.row_bytes();
    const auto* first = static_cast<const std::byte*>(rows.data);
    const std::uint64_t given = std::min<std::uint64_t>(first_chunk_ * chunk_rows - begin, rows.count);
    std::vector<Communicator::Message> messages;
    if (given > 0) {
        const int to = rank_of(begin / chunk_rows * chunk_rows, all);
        messages.push_back({to, std::vector<std::byte>(first, first + given * row_bytes)});
    }
    copy_.assign(first + given * row_bytes, first + rows.count * row_bytes);
    for (const Communicator::Message& came : ranks.exchange(messages)) {
        copy_.insert(copy_.end(), came.bytes.begin(), came.bytes.end());
    }
    rows_.data = copy_.data();
    rows_.count = copy_.size() / row_bytes;
}

}  // namespace scree::io
