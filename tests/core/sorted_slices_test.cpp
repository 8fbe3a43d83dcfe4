#include "core/parallel/sorted_slices.hpp"

#include <gtest/gtest.h>

#include "core/parallel/together.hpp"

namespace scree {
namespace {

TEST(Division, SlicesAreEvenAndCoverAll) {
    for (const std::uint64_t granule : {1U, 3U, 8192U}) {
        for (const std::uint64_t total :
             {std::uint64_t{0}, std::uint64_t{3}, std::uint64_t{100000}, std::uint64_t{1} << 62}) {
            for (const int ranks : {1, 2, 5, 100000}) {
                const Division division{total, granule, ranks};
                EXPECT_EQ(division.first(0), 0U);
                EXPECT_EQ(division.first(ranks), total);
                const std::uint64_t most = (total / granule / static_cast<std::uint64_t>(ranks) + 2) * granule;
                for (int r = 0; r < ranks; r += 1 + ranks / 7) {
                    const std::uint64_t first = division.first(r), end = division.first(r + 1);
                    ASSERT_LE(first, end);
                    ASSERT_LE(end - first, most);
                    ASSERT_TRUE(first % granule == 0 || first == total);
                }
            }
        }
    }
}

TEST(SortedSlices, OneRankSortsAndLeavesGhostsOut) {
    Bodies bodies;
    for (std::uint64_t i = 0; i < 4; ++i) {
        const auto x = static_cast<double>(i);
        bodies.id.push_back(BodyId{10 * i});
        bodies.radius.push_back(x);
        bodies.mass.push_back(2.0 * x);
        bodies.material.push_back(MaterialIndex{static_cast<std::uint16_t>(i)});
        bodies.position.emplace_back(x, 0.0, 0.0);
        bodies.velocity.emplace_back(0.0, x, 0.0);
        bodies.ghost.push_back(i == 2 ? 1 : 0);
    }
    const BodySlice slice = slice_bodies(bodies, 1, Communicator::self());
    ASSERT_EQ(slice.bodies.size(), 3U);
    EXPECT_EQ(raw(slice.bodies.id[2]), 30U);
    EXPECT_EQ(slice.bodies.velocity[2].y(), 3.0);
    EXPECT_FALSE(slice.bodies.has_spin());
    EXPECT_FALSE(slice.arrays.spin);

    std::vector<ContactRecord> contacts(3);
    contacts[0].key = ContactKey::wall(BodyId{1}, WallIndex{0}, 2);
    contacts[1].key = ContactKey::wall(BodyId{1}, WallIndex{0}, 1);
    contacts[2].key = ContactKey::bodies(BodyId{1}, BodyId{7});
    for (std::size_t i = 0; i < 3; ++i) contacts[i].gap = static_cast<double>(i);
    const std::vector<ContactRecord> sorted = slice_contacts(contacts, 1, Communicator::self());
    EXPECT_EQ(sorted[0].gap, 2.0);
    EXPECT_EQ(sorted[1].gap, 1.0);
    EXPECT_EQ(sorted[2].gap, 0.0);
}

TEST(Together, AFaultIsThrownAsItIs) {
    EXPECT_NO_THROW(together(Communicator::self(), [] {}));
    EXPECT_EQ(fault_of([] { throw IoError("file: full"); }), "file: full");
    EXPECT_NO_THROW(agree_on_fault("", Communicator::self()));
    EXPECT_THROW(agree_on_fault("file: full", Communicator::self()), IoError);
}

}  // namespace
}  // namespace scree
