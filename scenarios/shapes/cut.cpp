#include "scenarios/shapes/cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace scree::scenarios {
namespace {

constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
using Index = std::uint32_t;

// Distances [m] and sides of the corners.
struct Sides {
    std::vector<double> distance;
    std::vector<std::uint8_t> above;
    std::size_t lowest = 0, highest = 0;
};

Sides sides_of(const Polyhedron& body, const CutPlane& plane) {
    Sides sides;
    for (std::size_t v = 0; v < body.vertex.size(); ++v) {
        const double s = plane.normal.dot(body.vertex[v]) - plane.offset;
        sides.distance.push_back(s);
        sides.above.push_back(s > 0.0);
        if (s < sides.distance[sides.lowest]) sides.lowest = v;
        if (s > sides.distance[sides.highest]) sides.highest = v;
    }
    return sides;
}

// Corners of a side that do not hang together with its farthest corner go to the other side.
void join(const Polyhedron& body, Sides& sides, std::uint8_t above) {
    std::vector<std::uint8_t> reached(body.vertex.size(), 0);
    reached[above ? sides.highest : sides.lowest] = 1;
    for (bool again = true; again;) {
        again = false;
        for (const auto& loop : body.face)
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const Index a = loop[k], b = loop[(k + 1) % loop.size()];
                if (sides.above[a] != above || sides.above[b] != above || reached[a] == reached[b]) continue;
                reached[a] = reached[b] = 1;
                again = true;
            }
    }
    for (std::size_t v = 0; v < reached.size(); ++v)
        if (sides.above[v] == above && reached[v] == 0) sides.above[v] = !above;
}

class Cutter {
  public:
    Cutter(const Polyhedron& body, const CutPlane& plane) : body_(body), sides_(sides_of(body, plane)) {}

    double above() const { return sides_.distance[sides_.highest]; }
    double below() const { return -sides_.distance[sides_.lowest]; }

    void cross() {
        join(body_, sides_, 0);
        join(body_, sides_, 1);
        for (const auto& loop : body_.face)
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const Index a = loop[k], b = loop[(k + 1) % loop.size()];
                if (a < b && sides_.above[a] != sides_.above[b])
                    crossed_.emplace_back(a, b);  // each edge once: its other
            }                                     // face has it as (b, a)
        std::sort(crossed_.begin(), crossed_.end());
    }

    Polyhedron part(std::uint8_t above) const {
        Polyhedron result{body_.vertex, {}};
        for (const auto& [a, b] : crossed_) result.vertex.push_back(crossing(a, b));
        std::vector<Index> next(crossed_.size(), kNone);  // around the cut, seen from outside of this part
        for (const auto& loop : body_.face) {
            std::vector<Index> kept;
            Index leaves = kNone, enters = kNone;
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const Index a = loop[k], b = loop[(k + 1) % loop.size()];
                if (sides_.above[a] == above) kept.push_back(a);
                if (sides_.above[a] == sides_.above[b]) continue;
                const Index place = place_of(a, b);
                kept.push_back(static_cast<Index>(body_.vertex.size()) + place);
                (sides_.above[a] == above ? leaves : enters) = place;
            }
            if (leaves != kNone) next[enters] = leaves;
            if (std::any_of(loop.begin(), loop.end(), [&](Index v) { return sides_.above[v] == above; }))
                result.face.push_back(std::move(kept));
        }
        auto& cap = result.face.emplace_back();
        for (Index at = 0; cap.empty() || at != 0; at = next[at]) {
            SCREE_CHECK(at < next.size() && cap.size() < next.size());
            cap.push_back(static_cast<Index>(body_.vertex.size()) + at);
        }
        SCREE_CHECK(cap.size() == crossed_.size());
        drop_unused_vertices(result);
        return result;
    }

  private:
    Index place_of(Index a, Index b) const {
        const auto key = std::minmax(a, b);
        const auto it =
            std::lower_bound(crossed_.begin(), crossed_.end(), std::pair<Index, Index>(key.first, key.second));
        return static_cast<Index>(it - crossed_.begin());
    }
    // Corners that were moved to the other side by join lie on the plane but for round-off: the edge is crossed there.
    Vec3 crossing(Index a, Index b) const {
        const double s = sides_.distance[a], t = sides_.distance[b];
        if ((s > 0.0) == (t > 0.0)) return std::abs(s) <= std::abs(t) ? body_.vertex[a] : body_.vertex[b];
        return body_.vertex[a] + s / (s - t) * (body_.vertex[b] - body_.vertex[a]);
    }

    const Polyhedron& body_;
    Sides sides_;
    std::vector<std::pair<Index, Index>> crossed_;  // edges, sorted
};

}  // namespace

CutParts cut(const Polyhedron& body, const CutPlane& plane, double thickness) {
    Cutter cutter(body, plane);
    if (cutter.above() <= thickness) return {body, {}};
    if (cutter.below() <= thickness) return {{}, body};
    cutter.cross();
    return {cutter.part(0), cutter.part(1)};
}

Polyhedron cut_below(const Polyhedron& body, const CutPlane& plane, double thickness) {
    Cutter cutter(body, plane);
    if (cutter.above() <= thickness) return body;
    if (cutter.below() <= thickness) return {};
    cutter.cross();
    return cutter.part(0);
}

}  // namespace scree::scenarios
