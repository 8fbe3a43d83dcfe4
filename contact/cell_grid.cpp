#include "contact/cell_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "core/radix_sort.hpp"

namespace scree::contact {
namespace {

constexpr int kKeyBits = 62;  // of a cell's three indices together; scenes that need more get wider cells

bool overlap(const Ball& a, const Ball& b) {
    const double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
    const double reach = a.radius + b.radius;
    return dx * dx + dy * dy + dz * dz <= reach * reach;
}

BodyPair ordered(std::uint32_t i, std::uint32_t j) {
    return {std::min(i, j), std::max(i, j)};
}

}  // namespace

std::int64_t CellGrid::Level::index(double x, int direction) const {
    return static_cast<std::int64_t>(std::floor((x - lower[direction]) / width)) + 1;
}

std::uint64_t CellGrid::Level::pack(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return ((static_cast<std::uint64_t>(z) << bits[1] | static_cast<std::uint64_t>(y)) << bits[0]) |
           static_cast<std::uint64_t>(x);
}

void CellGrid::fill(Level& level, const std::vector<Ball>& balls, const std::vector<std::uint32_t>& bodies) {
    double upper[3];
    const Ball& first = balls[bodies.front()];
    const double start[3] = {first.x, first.y, first.z};
    for (int d = 0; d < 3; ++d) level.lower[d] = upper[d] = start[d];
    for (const std::uint32_t i : bodies) {
        const double x[3] = {balls[i].x, balls[i].y, balls[i].z};
        for (int d = 0; d < 3; ++d) {
            level.lower[d] = std::min(level.lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
        }
    }
    const auto key_bits = [&] {
        int sum = 0;
        for (int d = 0; d < 3; ++d) {
            const double cells = std::min((upper[d] - level.lower[d]) / level.width, std::ldexp(1.0, kKeyBits));
            level.bits[d] = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(cells) + 2));
            sum += level.bits[d];
        }
        return sum;
    };
    while (key_bits() > kKeyBits) level.width *= 2.0;
    keyed_.clear();
    for (const std::uint32_t i : bodies)
        keyed_.push_back(
            {level.pack(level.index(balls[i].x, 0), level.index(balls[i].y, 1), level.index(balls[i].z, 2)), i});
    radix_sort(keyed_, scratch_, [](const Keyed& k) { return k.key; });
    level.key.clear();
    level.begin.clear();
    level.ball.clear();
    level.body.clear();
    for (const Keyed& k : keyed_) {
        if (level.key.empty() || level.key.back() != k.key) {
            level.key.push_back(k.key);
            level.begin.push_back(static_cast<std::uint32_t>(level.body.size()));
        }
        level.ball.push_back(balls[k.body]);
        level.body.push_back(k.body);
    }
    level.begin.push_back(static_cast<std::uint32_t>(level.body.size()));
}

void CellGrid::pairs_within(const Level& level, std::vector<BodyPair>& pairs) {
    const std::size_t cells = level.key.size();
    const auto look = [&](std::uint32_t m, std::uint32_t from, std::uint32_t to) {
        const Ball ball = level.ball[m];
        for (std::uint32_t k = from; k < to; ++k)
            if (overlap(ball, level.ball[k])) pairs.push_back(ordered(level.body[m], level.body[k]));
    };
    // the rows that come later: (dy, dz) = (1, 0) (-1, 1) (0, 1) (1, 1), as differences of the key
    const auto row = std::uint64_t{1} << level.bits[0], layer = std::uint64_t{1} << (level.bits[0] + level.bits[1]);
    const std::uint64_t later[4] = {row, layer - row, layer, layer + row};
    std::size_t at[4] = {0, 0, 0, 0};  // first cell of each row that may be a neighbour
    for (std::size_t c = 0; c < cells; ++c) {
        const std::uint64_t key = level.key[c];
        const std::uint32_t begin = level.begin[c], end = level.begin[c + 1];
        // its own cell, and the next one of its row
        const std::uint32_t own_end = c + 1 < cells && level.key[c + 1] == key + 1 ? level.begin[c + 2] : end;
        for (std::uint32_t m = begin; m < end; ++m) look(m, m + 1, own_end);
        for (int r = 0; r < 4; ++r) {
            std::size_t& p = at[r];
            while (p < cells && level.key[p] < key + later[r] - 1) ++p;
            std::size_t q = p;
            while (q < cells && level.key[q] <= key + later[r] + 1) ++q;
            if (q == p) continue;
            for (std::uint32_t m = begin; m < end; ++m) look(m, level.begin[p], level.begin[q]);
        }
    }
}

void CellGrid::pairs_between(const Level& fine, const Level& coarse, std::vector<BodyPair>& pairs) {
    for (std::size_t m = 0; m < fine.ball.size(); ++m) {
        const Ball& ball = fine.ball[m];
        // a partner's centre is at most radius + width / 2 away
        const double reach = ball.radius + 0.5 * coarse.width;
        std::int64_t low[3], high[3];
        const double x[3] = {ball.x, ball.y, ball.z};
        bool near = true;
        for (int d = 0; d < 3; ++d) {
            const std::int64_t cells = (std::int64_t{1} << coarse.bits[d]) - 1;
            low[d] = std::max<std::int64_t>(coarse.index(x[d] - reach, d), 0);
            high[d] = std::min<std::int64_t>(coarse.index(x[d] + reach, d), cells);
            near = near && low[d] <= high[d];
        }
        if (!near) continue;
        for (std::int64_t z = low[2]; z <= high[2]; ++z)
            for (std::int64_t y = low[1]; y <= high[1]; ++y) {
                const auto from = std::lower_bound(coarse.key.begin(), coarse.key.end(), coarse.pack(low[0], y, z));
                const auto to = std::upper_bound(from, coarse.key.end(), coarse.pack(high[0], y, z));
                const std::uint32_t last = coarse.begin[static_cast<std::size_t>(to - coarse.key.begin())];
                for (std::uint32_t k = coarse.begin[static_cast<std::size_t>(from - coarse.key.begin())]; k < last; ++k)
                    if (overlap(ball, coarse.ball[k])) pairs.push_back(ordered(fine.body[m], coarse.body[k]));
            }
    }
}

void CellGrid::find_pairs(const std::vector<Ball>& balls, std::vector<BodyPair>& pairs) {
    if (balls.empty()) return;
    // A ball of radius r lives where width / 4 < r <= width / 2, a power of two; when all radii lie within a factor of
    // two, the widest ball sets the width of the one level instead.
    double smallest = balls[0].radius, largest = balls[0].radius;
    for (const Ball& b : balls) {
        smallest = std::min(smallest, b.radius);
        largest = std::max(largest, b.radius);
    }
    const bool one_level = largest <= 2.0 * smallest;
    std::map<int, std::vector<std::uint32_t>> of_level;
    for (std::uint32_t i = 0; i < balls.size(); ++i) of_level[one_level ? 0 : std::ilogb(balls[i].radius)].push_back(i);
    levels_.resize(of_level.size());
    std::size_t k = 0;
    for (const auto& [exponent, bodies] : of_level) {
        levels_[k].width = one_level ? 2.0 * largest : 4.0 * std::ldexp(1.0, exponent);
        fill(levels_[k++], balls, bodies);
    }
    for (std::size_t fine = 0; fine < levels_.size(); ++fine) {
        pairs_within(levels_[fine], pairs);
        for (std::size_t coarse = fine + 1; coarse < levels_.size(); ++coarse)
            pairs_between(levels_[fine], levels_[coarse], pairs);
    }
}

std::size_t CellGrid::bytes() const {
    std::size_t sum = (keyed_.capacity() + scratch_.capacity()) * sizeof(Keyed);
    for (const Level& level : levels_)
        sum += level.key.capacity() * 8 + (level.begin.capacity() + level.body.capacity()) * 4 +
               level.ball.capacity() * sizeof(Ball);
    return sum;
}

}  // namespace scree::contact
