#include "contact/polyhedra/closest_points.hpp"

#include "contact/polyhedra/simplex.hpp"

namespace scree::contact {
namespace {

using detail::Simplex;

constexpr int kMostTurns = 64;
constexpr double kRoundOff = 4.0 * std::numeric_limits<double>::epsilon();
constexpr double kNothing = 1e-14;  // of the sizes: a distance that is all round-off

ClosestPoints answer(Nearness nearness, const Vec3& v, double bound, const Simplex& simplex) {
    ClosestPoints result{nearness, v, bound, std::min(simplex.size, 3), {}, {}};
    for (std::size_t i = 0; i < static_cast<std::size_t>(result.corners); ++i) {
        result.on_a[i] = simplex.corner[i].a, result.on_b[i] = simplex.corner[i].b;
    }
    return result;
}

}  // namespace

ClosestPoints closest_points(const Placed& a, const Placed& b, double margin) {
    const Vec3 r = a.position - b.position;
    const double size = a.shape->radius + b.shape->radius, nothing = kNothing * size;
    Simplex simplex;
    Vec3 v = r;  // a point of the difference, for both centres are inside
    if (v.squaredNorm() <= nothing * nothing) return answer(Nearness::overlapping, v, 0.0, simplex);
    double square = v.squaredNorm(), best_bound = -std::numeric_limits<double>::infinity();
    for (int turn = 1; turn <= kMostTurns; ++turn) {
        const std::uint32_t ia = lowest(a, v).vertex, ib = highest(b, v).vertex;
        const Vec3 w = (a.vertex[ia] + r) - b.vertex[ib];
        const double length = std::sqrt(square), bound = v.dot(w);
        best_bound = std::max(best_bound, bound / length);
        if (bound > margin * length && bound > 0.0) return answer(Nearness::far, v, best_bound, simplex);
        if (simplex.size > 0 && square - bound <= kRoundOff * (square + size * length)) break;
        Simplex next = simplex;
        next.corner[static_cast<std::size_t>(next.size++)] = {w, ia, ib, 0.0};
        next.reduce();
        if (next.holds_origin) return answer(Nearness::overlapping, v, best_bound, simplex);
        const Vec3 nearest = next.nearest();
        const double nearest_square = nearest.squaredNorm();
        // Round-off has the last word: a simplex that comes no nearer is the old one again.
        if (simplex.size > 0 && nearest_square >= square) break;
        simplex = next, v = nearest, square = nearest_square;
        if (square <= nothing * nothing) return answer(Nearness::overlapping, v, best_bound, simplex);
    }
    return answer(Nearness::near, v, best_bound, simplex);
}

}  // namespace scree::contact
