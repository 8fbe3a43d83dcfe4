#include "contact/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/random.hpp"

namespace scree::contact {
namespace {

std::int64_t cell_of(double x, double width) {
    return static_cast<std::int64_t>(std::floor(x / width));
}

std::uint64_t hash(std::int64_t x, std::int64_t y, std::int64_t z) {
    return mix64(static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ULL ^
                 static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fULL ^ static_cast<std::uint64_t>(z));
}

bool overlap(const Ball& a, const Ball& b) {
    const double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
    const double reach = a.radius + b.radius;
    return dx * dx + dy * dy + dz * dz <= reach * reach;
}

void add_pair(std::uint32_t i, std::uint32_t j, const std::vector<Ball>& balls,
              std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
    if (overlap(balls[i], balls[j])) pairs.emplace_back(std::min(i, j), std::max(i, j));
}

}  // namespace

const CellGrid::Cell* CellGrid::Level::find(std::int64_t x, std::int64_t y, std::int64_t z) const {
    for (std::uint64_t slot = hash(x, y, z) & mask;; slot = (slot + 1) & mask) {
        if (table[slot] == 0) return nullptr;
        const Cell& cell = cells[table[slot] - 1];
        if (cell.x == x && cell.y == y && cell.z == z) return &cell;
    }
}

void CellGrid::fill_level(Level& level, const std::vector<Ball>& balls, std::vector<std::uint32_t>& bodies) {
    keyed_.clear();
    for (const std::uint32_t i : bodies) {
        const Ball& ball = balls[i];
        keyed_.push_back({cell_of(ball.x, level.width), cell_of(ball.y, level.width), cell_of(ball.z, level.width), i});
    }
    std::sort(keyed_.begin(), keyed_.end(), [](const Keyed& a, const Keyed& b) {
        return std::tie(a.z, a.y, a.x, a.body) < std::tie(b.z, b.y, b.x, b.body);
    });
    level.members.clear();
    level.cells.clear();
    for (const Keyed& k : keyed_) {
        if (level.cells.empty() || level.cells.back().x != k.x || level.cells.back().y != k.y ||
            level.cells.back().z != k.z) {
            const auto at = static_cast<std::uint32_t>(level.members.size());
            level.cells.push_back({k.x, k.y, k.z, at, at});
        }
        level.members.push_back(k.body);
        ++level.cells.back().end;
    }
    std::size_t slots = 16;
    while (slots < 2 * level.cells.size()) slots *= 2;
    level.mask = slots - 1;
    level.table.assign(slots, 0);
    for (std::size_t c = 0; c < level.cells.size(); ++c) {
        const Cell& cell = level.cells[c];
        std::uint64_t slot = hash(cell.x, cell.y, cell.z) & level.mask;
        while (level.table[slot] != 0) slot = (slot + 1) & level.mask;
        level.table[slot] = static_cast<std::uint32_t>(c + 1);
    }
}

void CellGrid::pairs_within(const Level& level, const std::vector<Ball>& balls,
                            std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
    for (const Cell& cell : level.cells) {
        for (std::uint32_t m = cell.begin; m < cell.end; ++m)
            for (std::uint32_t k = m + 1; k < cell.end; ++k) add_pair(level.members[m], level.members[k], balls, pairs);
        // the 13 neighbours that come later in (z, y, x): each pair of cells is looked at once
        for (int n = 14; n < 27; ++n) {
            const Cell* other = level.find(cell.x + n % 3 - 1, cell.y + n / 3 % 3 - 1, cell.z + n / 9 - 1);
            if (other == nullptr) continue;
            for (std::uint32_t m = cell.begin; m < cell.end; ++m)
                for (std::uint32_t k = other->begin; k < other->end; ++k)
                    add_pair(level.members[m], level.members[k], balls, pairs);
        }
    }
}

void CellGrid::pairs_between(const Level& fine, const Level& coarse, const std::vector<Ball>& balls,
                             std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
    for (const std::uint32_t i : fine.members) {
        const Ball& ball = balls[i];
        // a partner's centre is at most radius_i + width / 2 away
        const double reach = ball.radius + 0.5 * coarse.width;
        const auto low = [&](double x) { return cell_of(x - reach, coarse.width); };
        const auto high = [&](double x) { return cell_of(x + reach, coarse.width); };
        for (std::int64_t z = low(ball.z); z <= high(ball.z); ++z)
            for (std::int64_t y = low(ball.y); y <= high(ball.y); ++y)
                for (std::int64_t x = low(ball.x); x <= high(ball.x); ++x) {
                    const Cell* other = coarse.find(x, y, z);
                    if (other == nullptr) continue;
                    for (std::uint32_t k = other->begin; k < other->end; ++k)
                        add_pair(i, coarse.members[k], balls, pairs);
                }
    }
}

void CellGrid::find_pairs(const std::vector<Ball>& balls, std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
    if (balls.empty()) return;
    // Level k has cells of width 2^k; a ball of radius r lives where 2^(k-1) < 2 r <= 2^k. When all radii lie within a
    // factor of two, the widest ball sets the width of the one level instead.
    double smallest = balls[0].radius, largest = balls[0].radius;
    for (const Ball& b : balls) {
        smallest = std::min(smallest, b.radius);
        largest = std::max(largest, b.radius);
    }
    std::map<int, std::vector<std::uint32_t>> of_level;
    const bool one_level = largest <= 2.0 * smallest;
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
        int exponent = 0;
        if (!one_level) exponent = std::ilogb(balls[i].radius);
        of_level[exponent].push_back(i);
    }
    levels_.resize(of_level.size());
    std::size_t k = 0;
    for (auto& [exponent, bodies] : of_level) {
        levels_[k].width = one_level ? 2.0 * largest : 4.0 * std::ldexp(1.0, exponent);
        fill_level(levels_[k], balls, bodies);
        ++k;
    }
    for (std::size_t fine = 0; fine < levels_.size(); ++fine) {
        pairs_within(levels_[fine], balls, pairs);
        for (std::size_t coarse = fine + 1; coarse < levels_.size(); ++coarse)
            pairs_between(levels_[fine], levels_[coarse], balls, pairs);
    }
}

std::size_t CellGrid::bytes() const {
    std::size_t sum = keyed_.capacity() * sizeof(Keyed);
    for (const Level& level : levels_)
        sum += level.members.capacity() * 4 + level.cells.capacity() * sizeof(Cell) + level.table.capacity() * 4;
    return sum;
}

}  // namespace scree::contact
