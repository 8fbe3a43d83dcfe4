#include "contact/cell_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>

#include "core/radix_sort.hpp"
#include "core/simd.hpp"

namespace scree::contact {
namespace {

constexpr int kKeyBits = 62;  // of a cell's three indices together; scenes that need more get wider cells

BodyPair ordered(std::uint32_t i, std::uint32_t j) {
    return {std::min(i, j), std::max(i, j)};
}

}  // namespace

std::int64_t CellGrid::Level::index(double at, int direction) const {
    // what lies far outside is outside
    const double cells = std::clamp((at - lower[direction]) / width, -2.0, std::ldexp(1.0, kKeyBits));
    return static_cast<std::int64_t>(std::floor(cells)) + 1;
}

std::uint64_t CellGrid::Level::pack(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return ((static_cast<std::uint64_t>(k) << bits[1] | static_cast<std::uint64_t>(j)) << bits[0]) |
           static_cast<std::uint64_t>(i);
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
    level.body.clear();
    for (const Keyed& k : keyed_) {
        if (level.key.empty() || level.key.back() != k.key) {
            level.key.push_back(k.key);
            level.begin.push_back(static_cast<std::uint32_t>(level.body.size()));
        }
        level.body.push_back(k.body);
    }
    const std::size_t n = level.body.size();
    level.begin.push_back(static_cast<std::uint32_t>(n));
    for (std::vector<double>* column : {&level.x, &level.y, &level.z, &level.radius}) column->resize(n + kLanes - 1);
    for (std::size_t m = 0; m < n; ++m) {
        const Ball& ball = balls[level.body[m]];
        level.x[m] = ball.x;
        level.y[m] = ball.y;
        level.z[m] = ball.z;
        level.radius[m] = ball.radius;
    }
}

// The partners of one ball, looked for eight at a time: |x_i - x_j|^2 <= (radius_i + radius_j)^2. Bits of up to eight
// packs are kept before they are walked, for a walk whose length nobody can foretell costs as much as some packs.
class CellGrid::Search {
  public:
    Search(std::uint32_t body, const Ball& ball, const Level& level, std::vector<BodyPair>& pairs)
        : body_(body),
          x_(Pack::all(ball.x)),
          y_(Pack::all(ball.y)),
          z_(Pack::all(ball.z)),
          radius_(Pack::all(ball.radius)),
          level_(level),
          pairs_(pairs) {}
    ~Search() { walk(); }
    Search(const Search&) = delete;
    Search& operator=(const Search&) = delete;

    // Balls `from` to `to` of the level.
    SCREE_INLINE void look(std::uint32_t from, std::uint32_t to) {
        for (std::uint32_t k = from; k < to; k += kLanes) {
            const Pack dx = x_ - Pack::load_anywhere(level_.x.data() + k);
            const Pack dy = y_ - Pack::load_anywhere(level_.y.data() + k);
            const Pack dz = z_ - Pack::load_anywhere(level_.z.data() + k);
            const Pack reach = radius_ + Pack::load_anywhere(level_.radius.data() + k);
            std::uint64_t hits = mask_less_equal(dx * dx + dy * dy + dz * dz, reach * reach);
            if (to - k < kLanes) hits &= (1U << (to - k)) - 1;
            start_[packs_] = k;
            hits_ |= hits << (kLanes * packs_);
            packs_ += hits != 0 ? 1 : 0;
            if (packs_ == kPacks) walk();
        }
    }

  private:
    static constexpr std::uint32_t kPacks = 64 / kLanes;

    SCREE_INLINE void walk() {
        for (; hits_ != 0; hits_ &= hits_ - 1) {
            const auto bit = static_cast<std::uint32_t>(std::countr_zero(hits_));
            pairs_.push_back(ordered(body_, level_.body[start_[bit / kLanes] + bit % kLanes]));
        }
        packs_ = 0;
    }

    std::uint32_t body_;
    Pack x_, y_, z_, radius_;
    const Level& level_;
    std::vector<BodyPair>& pairs_;
    std::uint64_t hits_ = 0;
    std::uint32_t packs_ = 0, start_[kPacks];
};

void CellGrid::pairs_within(const Level& level, std::vector<BodyPair>& pairs) {
    const std::size_t cells = level.key.size();
    // the rows that come later: (dy, dz) = (1, 0) (-1, 1) (0, 1) (1, 1), as differences of the key
    const auto row = std::uint64_t{1} << level.bits[0], layer = std::uint64_t{1} << (level.bits[0] + level.bits[1]);
    const std::uint64_t later[4] = {row, layer - row, layer, layer + row};
    std::size_t at[4] = {0, 0, 0, 0};  // first cell of each row that may be a neighbour
    for (std::size_t c = 0; c < cells; ++c) {
        const std::uint64_t key = level.key[c];
        const std::uint32_t begin = level.begin[c], end = level.begin[c + 1];
        // its own cell, and the next one of its row
        const std::uint32_t own_end = c + 1 < cells && level.key[c + 1] == key + 1 ? level.begin[c + 2] : end;
        std::uint32_t from[4], to[4];
        for (int r = 0; r < 4; ++r) {
            std::size_t& p = at[r];
            while (p < cells && level.key[p] < key + later[r] - 1) ++p;
            std::size_t q = p;
            while (q < cells && level.key[q] <= key + later[r] + 1) ++q;
            from[r] = level.begin[p];
            to[r] = level.begin[q];
        }
        for (std::uint32_t m = begin; m < end; ++m) {
            Search search(level.body[m], level.ball(m), level, pairs);
            search.look(m + 1, own_end);
            for (int r = 0; r < 4; ++r) search.look(from[r], to[r]);
        }
    }
}

void CellGrid::find_in(const Level& level, std::uint32_t body, const Ball& ball, std::vector<BodyPair>& pairs) {
    // a partner's centre is at most radius + width / 2 away
    const double reach = ball.radius + 0.5 * level.width;
    std::int64_t low[3], high[3];
    const double x[3] = {ball.x, ball.y, ball.z};
    double rows = 1.0;
    for (int d = 0; d < 3; ++d) {
        const std::int64_t cells = (std::int64_t{1} << level.bits[d]) - 1;
        low[d] = std::max<std::int64_t>(level.index(x[d] - reach, d), 0);
        high[d] = std::min<std::int64_t>(level.index(x[d] + reach, d), cells);
        if (low[d] > high[d]) return;
        if (d > 0) rows *= static_cast<double>(high[d] - low[d] + 1);
    }
    Search search(body, ball, level, pairs);
    const auto all = static_cast<std::uint32_t>(level.body.size());
    if (rows * kLanes > all) return search.look(0, all);  // a large ball among small ones: no row by row
    for (std::int64_t z = low[2]; z <= high[2]; ++z)
        for (std::int64_t y = low[1]; y <= high[1]; ++y) {
            const auto from = std::lower_bound(level.key.begin(), level.key.end(), level.pack(low[0], y, z));
            const auto to = std::upper_bound(from, level.key.end(), level.pack(high[0], y, z));
            search.look(level.begin[static_cast<std::size_t>(from - level.key.begin())],
                        level.begin[static_cast<std::size_t>(to - level.key.begin())]);
        }
}

void CellGrid::pairs_between(const Level& fine, const Level& coarse, std::vector<BodyPair>& pairs) {
    for (std::uint32_t m = 0; m < fine.body.size(); ++m) find_in(coarse, fine.body[m], fine.ball(m), pairs);
}

void CellGrid::find_partners(std::uint32_t body, const Ball& ball, std::vector<BodyPair>& pairs) const {
    for (const Level& level : levels_) find_in(level, body, ball, pairs);
}

void CellGrid::take_out(std::uint32_t body) {
    const Place place = place_[body];
    levels_[place.level].radius[place.index] = std::numeric_limits<double>::quiet_NaN();
    place_[body].level = kNowhere;
}

void CellGrid::rename(const std::vector<std::uint32_t>& name, std::size_t count) {
    std::vector<Place> renamed(count);
    for (std::uint32_t i = 0; i < place_.size(); ++i) {
        if (!holds(i)) continue;
        if (name[i] == kGone) {
            take_out(i);
            continue;
        }
        levels_[place_[i].level].body[place_[i].index] = name[i];
        renamed[name[i]] = place_[i];
    }
    place_.swap(renamed);
}

void CellGrid::find_pairs(const std::vector<Ball>& balls, std::vector<BodyPair>& pairs) {
    levels_.resize(balls.empty() ? 0 : levels_.size());
    place_.assign(balls.size(), {});
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
        fill(levels_[k], balls, bodies);
        for (std::uint32_t m = 0; m < bodies.size(); ++m)
            place_[levels_[k].body[m]] = {static_cast<std::uint32_t>(k), m};
        ++k;
    }
    for (std::size_t fine = 0; fine < levels_.size(); ++fine) {
        pairs_within(levels_[fine], pairs);
        for (std::size_t coarse = fine + 1; coarse < levels_.size(); ++coarse)
            pairs_between(levels_[fine], levels_[coarse], pairs);
    }
}

std::size_t CellGrid::bytes() const {
    std::size_t sum = (keyed_.capacity() + scratch_.capacity()) * sizeof(Keyed) + place_.capacity() * sizeof(Place);
    for (const Level& level : levels_)
        sum += level.key.capacity() * 8 + (level.begin.capacity() + level.body.capacity()) * 4 +
               (level.x.capacity() + level.y.capacity() + level.z.capacity() + level.radius.capacity()) * 8;
    return sum;
}

}  // namespace scree::contact
