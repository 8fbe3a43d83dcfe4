// Rows of numbers against sets.
#include "contact/sorted_rows.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/random.hpp"

namespace scree::contact {
namespace {

using Entry = SortedRows::Entry;

std::uint32_t below(Random& random, std::uint32_t n) {
    return static_cast<std::uint32_t>(random.uniform() * n);
}

std::vector<Entry> entries_of(const SortedRows& rows, std::uint32_t count) {
    std::vector<Entry> all;
    for (std::uint32_t i = 0; i < count; ++i)
        for (const std::uint32_t number : rows[i]) all.emplace_back(i, number);
    return all;
}

TEST(SortedRows, HoldWhatASetHolds) {
    Random random(1, 1, 0);
    for (int round = 0; round < 200; ++round) {
        std::uint32_t count = 1 + below(random, 30);
        std::set<Entry> expected;
        const auto some = [&](std::uint32_t most) {
            std::vector<Entry> entries;
            for (std::uint32_t k = below(random, most); k-- > 0;)
                entries.emplace_back(below(random, count), below(random, count));
            return entries;
        };
        for (const Entry& e : some(60)) expected.insert(e);
        SortedRows rows;
        rows.assign(count, {expected.rbegin(), expected.rend()});
        for (int k = 0; k < 4; ++k) {
            std::vector<Entry> more = some(12);
            const std::size_t before = expected.size();
            expected.insert(more.begin(), more.end());
            EXPECT_EQ(rows.insert(more), expected.size() > before);
            EXPECT_EQ(entries_of(rows, count), std::vector<Entry>(expected.begin(), expected.end()));
        }
        // some rows go, others come in between; in every other round numbers are those of rows
        const bool renumber = round % 2 == 0;
        std::vector<std::uint32_t> place(count);
        std::uint32_t next = 0;
        for (std::uint32_t& p : place) {
            next += below(random, 3) == 0 ? 2 : 0;
            p = below(random, 3) == 0 ? SortedRows::kGone : next++;
        }
        next += below(random, 3);
        rows.move_rows(place, next, renumber);
        std::vector<Entry> moved;
        for (const auto& [row, number] : expected) {
            const std::uint32_t to = renumber ? place[number] : number;
            if (place[row] != SortedRows::kGone && to != SortedRows::kGone) moved.emplace_back(place[row], to);
        }
        EXPECT_EQ(entries_of(rows, next), moved);
        EXPECT_EQ(rows.size(), moved.size());
    }
}

}  // namespace
}  // namespace scree::contact
