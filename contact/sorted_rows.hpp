// Rows of increasing numbers, one a body, one after the other in memory: the partners of bodies, the walls near them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace scree::contact {

class SortedRows {
  public:
    using Entry = std::pair<std::uint32_t, std::uint32_t>;  // row, number
    static constexpr std::uint32_t kGone = 0xffffffff;

    std::span<const std::uint32_t> operator[](std::size_t row) const {
        return {item_.data() + begin_[row], item_.data() + begin_[row + 1]};
    }
    std::size_t size() const { return item_.size(); }
    std::size_t bytes() const { return (begin_.capacity() + item_.capacity() + scratch_.capacity()) * 4; }

    // `rows` rows of these entries, in any order, none twice. Rows are short: dealt out by row, then sorted one by one.
    void assign(std::size_t rows, const std::vector<Entry>& entries) {
        begin_.assign(rows + 1, 0);
        item_.resize(entries.size());
        for (const Entry& e : entries) ++begin_[e.first];
        std::uint32_t end = 0;
        for (std::uint32_t& at : begin_) at = end += at;
        for (const Entry& e : entries) item_[--begin_[e.first]] = e.second;
        for (std::size_t i = 0; i < rows; ++i) std::sort(item_.begin() + begin_[i], item_.begin() + begin_[i + 1]);
    }

    // Adds those of the entries that are not there yet; false if all are. Sorts `entries`.
    bool insert(std::vector<Entry>& entries) {
        std::erase_if(entries, [this](const Entry& e) {
            const auto row = (*this)[e.first];
            return std::binary_search(row.begin(), row.end(), e.second);
        });
        if (entries.empty()) return false;
        std::sort(entries.begin(), entries.end());
        entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
        // from the back, each piece between two new entries moves at once
        const auto rows = static_cast<std::uint32_t>(begin_.size() - 1);
        std::size_t from = item_.size();
        item_.resize(item_.size() + entries.size());
        std::uint32_t row = rows;
        for (std::size_t k = entries.size(); k-- > 0;) {
            const auto [into, number] = entries[k];
            const auto at = static_cast<std::size_t>(
                std::upper_bound(item_.begin() + begin_[into],
                                 item_.begin() + std::min<std::size_t>(begin_[into + 1], from), number) -
                item_.begin());
            for (; row > into; --row) begin_[row] += static_cast<std::uint32_t>(k + 1);
            std::move_backward(item_.begin() + at, item_.begin() + from, item_.begin() + from + k + 1);
            item_[at + k] = number;
            from = at;
        }
        return true;
    }

    // Row i becomes row `place[i]`, increasing, unless that is kGone; rows in between are empty. If `renumber`, numbers
    // are places too.
    void move_rows(const std::vector<std::uint32_t>& place, std::size_t rows, bool renumber) {
        scratch_.assign(rows + 1, 0);
        std::uint32_t end = 0;
        std::size_t filled = 0;  // rows whose begin is known
        for (std::size_t i = 0; i < place.size(); ++i) {
            if (place[i] == kGone) continue;
            for (; filled <= place[i]; ++filled) scratch_[filled] = end;
            for (std::uint32_t k = begin_[i]; k < begin_[i + 1]; ++k) {
                const std::uint32_t number = renumber ? place[item_[k]] : item_[k];
                if (number != kGone) item_[end++] = number;
            }
        }
        for (; filled <= rows; ++filled) scratch_[filled] = end;
        item_.resize(end);
        begin_.swap(scratch_);
    }

  private:
    std::vector<std::uint32_t> begin_{0};  // rows + 1, into item_
    std::vector<std::uint32_t> item_, scratch_;
};

}  // namespace scree::contact
