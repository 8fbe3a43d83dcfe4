#include "contact/polyhedra/corners.hpp"

#include <algorithm>
#include <cmath>

namespace scree::contact::detail {
namespace {

// Twice the area of the triangle, positive if it is counter-clockwise.
double turn(const Corner& a, const Corner& b, const Corner& c) {
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

bool before(const Corner& a, const Corner& b) {
    return a.u != b.u ? a.u < b.u : a.v < b.v;
}

}  // namespace

void Corners::add(const Corner& corner) {
    for (int i = 0; i < size_; ++i) {
        Corner& other = item_[static_cast<std::size_t>(i)];
        const double du = corner.u - other.u, dv = corner.v - other.v;
        if (corner.key != other.key && du * du + dv * dv > same_square_) continue;
        const bool same_kind = other.key >> 30U == corner.key >> 30U, deeper = corner.gap < other.gap;
        const FeatureKey key = same_kind ? (deeper ? corner.key : other.key) : std::min(other.key, corner.key);
        const bool shallow = other.shallow && corner.shallow;
        if (deeper) other = corner;
        other.key = key, other.shallow = shallow;
        return;
    }
    if (size_ == kRoom) reduce(kRoom / 2);
    item_[static_cast<std::size_t>(size_++)] = corner;
}

void Corners::remove(int i) {
    for (--size_; i < size_; ++i) item_[static_cast<std::size_t>(i)] = item_[static_cast<std::size_t>(i) + 1];
}

int Corners::deepest() const {
    int best = 0;
    for (int i = 1; i < size_; ++i) {
        if ((*this)[i].gap < (*this)[best].gap) best = i;
    }
    return best;
}

// Whether it lies between two others that are at most `depth` less deep than it.
bool Corners::straight(const Corner& corner, double depth) const {
    for (int i = 0; i < size_; ++i) {
        for (int j = 0; j < size_; ++j) {
            const Corner &p = (*this)[i], &q = (*this)[j];
            if (i == j || &p == &corner || &q == &corner) continue;
            const double du = q.u - p.u, dv = q.v - p.v, square = du * du + dv * dv;
            const double t = ((corner.u - p.u) * du + (corner.v - p.v) * dv) / square;
            const double aside = turn(p, q, corner);
            if (t <= 0.0 || t >= 1.0 || aside * aside > same_square_ * square) continue;
            if (corner.gap >= p.gap + t * (q.gap - p.gap) - depth) return true;
        }
    }
    return false;
}

void Corners::straighten(double round_off) {
    const double little = 1e-2 * std::sqrt(same_square_);
    for (int i = size_ - 1; i >= 0; --i) {
        if ((*this)[i].shallow && straight((*this)[i], i == deepest() ? round_off : little)) remove(i);
    }
}

// Andrew's monotone chain (1979).
int Corners::hull(std::array<int, kRoom>& order) const {
    std::array<int, kRoom> sorted;
    for (int i = 0; i < size_; ++i) {
        int at = i;
        for (; at > 0 && before((*this)[i], (*this)[sorted[static_cast<std::size_t>(at) - 1]]); --at) {
            sorted[static_cast<std::size_t>(at)] = sorted[static_cast<std::size_t>(at) - 1];
        }
        sorted[static_cast<std::size_t>(at)] = i;
    }
    if (size_ < 3) {
        std::copy_n(sorted.begin(), size_, order.begin());
        return size_;
    }
    std::array<int, 2 * kRoom> chain;
    int n = 0;
    const auto extend = [&](int i, int from) {
        while (n >= from + 2 && turn((*this)[chain[static_cast<std::size_t>(n) - 2]],
                                     (*this)[chain[static_cast<std::size_t>(n) - 1]], (*this)[i]) <= 0.0) {
            --n;
        }
        chain[static_cast<std::size_t>(n++)] = i;
    };
    for (int i = 0; i < size_; ++i) extend(sorted[static_cast<std::size_t>(i)], 0);
    const int lower = n - 1;
    for (int i = size_ - 2; i >= 0; --i) extend(sorted[static_cast<std::size_t>(i)], lower);
    --n;  // the first one again
    std::copy_n(chain.begin(), n, order.begin());
    return n;
}

void Corners::reduce(int most) {
    while (size_ > most) {
        std::array<int, kRoom> order;
        const int n = hull(order), keep = deepest();
        const auto on_hull = [&](int i) { return std::find(order.begin(), order.begin() + n, i) != order.begin() + n; };
        const double open = 0.5 * (margin_ + (*this)[keep].gap);
        int worst = -1;
        const auto most_open = [&](const auto& may_go) {
            for (int i = 0; i < size_; ++i) {
                if (i != keep && may_go(i) && (worst < 0 || (*this)[i].gap > (*this)[worst].gap)) worst = i;
            }
        };
        most_open([&](int i) { return (*this)[i].gap > open; });
        if (worst < 0) most_open([&](int i) { return !on_hull(i); });
        if (worst < 0) worst = smallest_ear({order.data(), static_cast<std::size_t>(n)}, keep);
        remove(worst);
    }
}

// The corner of the hull whose loss costs the least area.
int Corners::smallest_ear(std::span<const int> hull, int keep) const {
    int worst = -1;
    double least = 0.0;
    for (std::size_t k = 0, n = hull.size(); k < n; ++k) {
        if (hull[k] == keep) continue;
        const double area = turn((*this)[hull[(k + n - 1) % n]], (*this)[hull[k]], (*this)[hull[(k + 1) % n]]);
        if (worst < 0 || area < least) worst = hull[k], least = area;
    }
    return worst;
}

double Corners::hull_area() const {
    if (size_ < 3) return 0.0;
    std::array<int, kRoom> order;
    const int n = hull(order);
    double twice = 0.0;
    for (int k = 1; k + 1 < n; ++k) {
        twice += turn((*this)[order[0]], (*this)[order[static_cast<std::size_t>(k)]],
                      (*this)[order[static_cast<std::size_t>(k) + 1]]);
    }
    return 0.5 * twice;
}

}  // namespace scree::contact::detail
