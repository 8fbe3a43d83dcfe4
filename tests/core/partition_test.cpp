// Recursive bisection of blocks: every block has one owner, boxes of blocks meet all owners in them, and the work is
// shared evenly where blocks allow it.
#include "core/parallel/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "core/random.hpp"

namespace scree {
namespace {

// A cloud of blocks with work of 1 to `heaviest`.
std::vector<BlockWork> cloud(std::uint64_t seed, int count, int side, std::uint64_t heaviest) {
    Random random(seed, 0, 0);
    std::vector<BlockWork> work;
    const auto index = [&] { return static_cast<std::int32_t>(random.uniform(-side, side)); };
    for (int k = 0; k < count; ++k) {
        const BlockIndex block{index(), index(), index()};
        work.push_back({block, 1 + random.bits() % heaviest});
    }
    return work;
}

std::vector<std::uint64_t> loads(const Partition& partition, const std::vector<BlockWork>& work, int parts) {
    std::vector<std::uint64_t> load(static_cast<std::size_t>(parts), 0);
    for (const BlockWork& b : work) load.at(static_cast<std::size_t>(partition.owner(b.block))) += b.work;
    return load;
}

TEST(Partition, OneRankOwnsAllSpace) {
    const Partition partition;
    EXPECT_EQ(partition.owner({-kMostBlocks, 0, kMostBlocks}), 0);
    EXPECT_EQ(Partition::bisect(Communicator::self(), cloud(1, 50, 9, 5), 1), partition);
}

TEST(Partition, OwnersOfABoxAreThoseOfItsBlocks) {
    Random random(7, 0, 0);
    for (const int parts : {2, 3, 5, 8, 13}) {
        const Partition partition = Partition::bisect(Communicator::self(), cloud(2, 400, 6, 9), parts);
        for (int k = 0; k < 200; ++k) {
            BlockIndex low{}, high{};
            for (std::size_t d = 0; d < 3; ++d) {
                low[d] = static_cast<std::int32_t>(random.uniform(-9.0, 9.0));
                high[d] = low[d] + static_cast<std::int32_t>(random.uniform(0.0, 5.0));
            }
            std::set<int> expected;
            for (std::int32_t x = low[0]; x <= high[0]; ++x)
                for (std::int32_t y = low[1]; y <= high[1]; ++y)
                    for (std::int32_t z = low[2]; z <= high[2]; ++z) expected.insert(partition.owner({x, y, z}));
            std::vector<int> found;
            partition.owners(low, high, found);
            EXPECT_EQ(found, std::vector<int>(expected.begin(), expected.end())) << parts << " parts, box " << k;
        }
    }
}

TEST(Partition, EvenWorkIsSharedEvenly) {
    // a slab of 64 x 16 x 1 equal blocks: powers of two divide it exactly
    std::vector<BlockWork> work;
    for (std::int32_t x = 0; x < 64; ++x)
        for (std::int32_t y = 0; y < 16; ++y) work.push_back({{x, y, -3}, 4});
    for (const int parts : {2, 4, 8, 16})
        for (const std::uint64_t load : loads(Partition::bisect(Communicator::self(), work, parts), work, parts))
            EXPECT_EQ(load, 4U * 64 * 16 / static_cast<std::uint64_t>(parts)) << parts << " parts";
    // and the first cut is across the long side, where the border is shortest
    const Partition halves = Partition::bisect(Communicator::self(), work, 2);
    EXPECT_NE(halves.owner({31, 5, -3}), halves.owner({32, 5, -3}));
    EXPECT_EQ(halves.owner({10, 0, -3}), halves.owner({10, 15, -3}));
}

TEST(Partition, AnyNumberOfPartsIsShared) {
    for (const int parts : {3, 5, 7, 12}) {
        const std::vector<BlockWork> work = cloud(11, 6000, 20, 1);
        const std::vector<std::uint64_t> load =
            loads(Partition::bisect(Communicator::self(), work, parts), work, parts);
        const double mean = 6000.0 / parts;
        EXPECT_LT(static_cast<double>(*std::max_element(load.begin(), load.end())), 1.3 * mean) << parts << " parts";
        EXPECT_EQ(std::accumulate(load.begin(), load.end(), std::uint64_t{0}), 6000U);
    }
}

TEST(Partition, MorePartsThanBlocksLeaveSomeEmpty) {
    const std::vector<BlockWork> one{{{3, 3, 3}, 10}};
    const std::vector<std::uint64_t> load = loads(Partition::bisect(Communicator::self(), one, 6), one, 6);
    EXPECT_EQ(std::count(load.begin(), load.end(), 10U), 1);
    EXPECT_EQ(std::count(load.begin(), load.end(), 0U), 5);
    const std::vector<BlockWork> none;
    EXPECT_EQ(loads(Partition::bisect(Communicator::self(), none, 4), none, 4).size(), 4U);
}

TEST(Partition, FarOutlierDoesNotTakeAHalfForItself) {
    // a thousand blocks close by and one a hundred thousand blocks away: histograms are coarse, shares stay sound
    std::vector<BlockWork> work = cloud(5, 1000, 5, 1);
    work.push_back({{100000, 0, 0}, 1});
    const std::vector<std::uint64_t> load = loads(Partition::bisect(Communicator::self(), work, 2), work, 2);
    EXPECT_LT(*std::max_element(load.begin(), load.end()), 700U);
}

}  // namespace
}  // namespace scree
