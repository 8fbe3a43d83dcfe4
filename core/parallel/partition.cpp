#include "core/parallel/partition.hpp"

#include <algorithm>
#include <limits>

namespace scree {
namespace {

constexpr std::int64_t kMostBins = 1024;  // of a histogram; wider parts are cut at multiples of several blocks
// The price of a unit of work beside a cut: it is held twice, and its velocities travel.
constexpr double kBorder = 0.15;

// A part of space that still has to be cut.
struct Part {
    int cut;           // its place in the tree
    int first, count;  // ranks
    std::array<std::int64_t, 3> low{}, shift{}, bins{};
    std::size_t histogram = 0;  // where its three histograms begin
};

// The extents of all parts, and with them the sizes of their histograms. Returns the sum of the sizes.
std::size_t measure(const Communicator& ranks, std::span<const BlockWork> work, std::span<const int> part_of,
                    std::vector<Part>& parts) {
    constexpr double kNone = -1e30;
    std::vector<double> extent(6 * parts.size(), kNone);  // highest, and the negative of the lowest
    for (std::size_t k = 0; k < work.size(); ++k)
        for (std::size_t d = 0; d < 3; ++d) {
            double* e = extent.data() + 6 * static_cast<std::size_t>(part_of[k]) + 2 * d;
            e[0] = std::max(e[0], static_cast<double>(work[k].block[d]));
            e[1] = std::max(e[1], -static_cast<double>(work[k].block[d]));
        }
    ranks.max(extent);
    std::size_t total = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        parts[p].histogram = total;
        for (std::size_t d = 0; d < 3; ++d) {
            const double high = extent[6 * p + 2 * d], low = -extent[6 * p + 2 * d + 1];
            parts[p].low[d] = high == kNone ? 0 : static_cast<std::int64_t>(low);
            const std::int64_t width = high == kNone ? 1 : static_cast<std::int64_t>(high - low) + 1;
            parts[p].shift[d] = 0;
            while ((width >> parts[p].shift[d]) >= kMostBins) ++parts[p].shift[d];
            parts[p].bins[d] = (width >> parts[p].shift[d]) + 1;
            total += static_cast<std::size_t>(parts[p].bins[d]);
        }
    }
    return total;
}

struct Choice {
    double price = std::numeric_limits<double>::infinity();
    int direction = 0;
    std::int64_t at = 0;
};

Choice choose(const Part& part, const std::vector<std::uint64_t>& histogram) {
    Choice best;
    const double share = static_cast<double>(part.count / 2) / part.count;
    std::size_t begin = part.histogram;
    for (std::size_t d = 0; d < 3; ++d) {
        const std::uint64_t* h = histogram.data() + begin;
        const auto bins = static_cast<std::size_t>(part.bins[d]);
        begin += bins;
        std::uint64_t total = 0;
        for (std::size_t b = 0; b < bins; ++b) total += h[b];
        double left = 0.0;
        const auto whole = static_cast<double>(std::max<std::uint64_t>(total, 1));
        for (std::size_t b = 1; b < bins; ++b) {  // the cut before bin b
            left += static_cast<double>(h[b - 1]);
            const double border = static_cast<double>(std::min(h[b - 1], h[b]));
            const double price =
                std::max(left / share, (whole - left) / (1.0 - share)) / whole + kBorder * 2.0 * border / whole;
            if (price < best.price)
                best = {price, static_cast<int>(d), part.low[d] + (static_cast<std::int64_t>(b) << part.shift[d])};
        }
    }
    if (best.price == std::numeric_limits<double>::infinity())
        best.at = part.low[0] + 1;  // one block: one half is empty
    return best;
}

}  // namespace

Partition Partition::bisect(const Communicator& ranks, std::span<const BlockWork> work, int parts_wanted) {
    Partition result;
    std::vector<Part> parts;
    if (parts_wanted > 1) parts.push_back({0, 0, parts_wanted});
    std::vector<int> part_of(work.size(), 0);  // -1: in a part that is done
    while (!parts.empty()) {
        std::vector<BlockWork> left_work;
        std::vector<int> left_part;
        for (std::size_t k = 0; k < work.size(); ++k)
            if (part_of[k] >= 0) {
                left_work.push_back(work[k]);
                left_part.push_back(part_of[k]);
            }
        std::vector<std::uint64_t> histogram(measure(ranks, left_work, left_part, parts), 0);
        for (std::size_t k = 0; k < left_work.size(); ++k) {
            const Part& part = parts[static_cast<std::size_t>(left_part[k])];
            std::size_t begin = part.histogram;
            for (std::size_t d = 0; d < 3; ++d) {
                const std::int64_t bin = (left_work[k].block[d] - part.low[d]) >> part.shift[d];
                histogram[begin + static_cast<std::size_t>(bin)] += left_work[k].work;
                begin += static_cast<std::size_t>(part.bins[d]);
            }
        }
        ranks.sum(histogram);
        std::vector<Part> next;
        std::vector<std::array<int, 2>> child(parts.size(), {-1, -1});  // indices into `next`
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const Part& part = parts[p];
            const Choice choice = choose(part, histogram);
            const int first[2] = {part.first, part.first + part.count / 2};
            const int count[2] = {part.count / 2, part.count - part.count / 2};
            int node[2];
            for (int side = 0; side < 2; ++side) {
                node[side] = static_cast<int>(result.cut_.size());
                result.cut_.push_back({-1, 0, first[side], 0});
                if (count[side] == 1) continue;
                child[p][static_cast<std::size_t>(side)] = static_cast<int>(next.size());
                next.push_back({node[side], first[side], count[side]});
            }
            result.cut_[static_cast<std::size_t>(part.cut)] = {choice.direction, static_cast<std::int32_t>(choice.at),
                                                               node[0], node[1]};
        }
        for (std::size_t k = 0; k < work.size(); ++k) {
            if (part_of[k] < 0) continue;
            const auto p = static_cast<std::size_t>(part_of[k]);
            const Cut& cut = result.cut_[static_cast<std::size_t>(parts[p].cut)];
            part_of[k] = child[p][work[k].block[static_cast<std::size_t>(cut.direction)] < cut.at ? 0 : 1];
        }
        parts = std::move(next);
    }
    return result;
}

int Partition::owner(const BlockIndex& block) const {
    const Cut* cut = cut_.data();
    while (cut->direction >= 0)
        cut = &cut_[static_cast<std::size_t>(block[static_cast<std::size_t>(cut->direction)] < cut->at ? cut->left
                                                                                                       : cut->right)];
    return cut->left;
}

void Partition::owners(const BlockIndex& low, const BlockIndex& high, std::vector<int>& ranks) const {
    int stack[64];
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const Cut& cut = cut_[static_cast<std::size_t>(stack[--depth])];
        if (cut.direction < 0) {
            ranks.push_back(cut.left);
            continue;
        }
        const auto d = static_cast<std::size_t>(cut.direction);
        if (high[d] >= cut.at) stack[depth++] = cut.right;  // left is taken from the stack first
        if (low[d] < cut.at) stack[depth++] = cut.left;
    }
}

}  // namespace scree
