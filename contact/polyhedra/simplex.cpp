#include "contact/polyhedra/simplex.hpp"

#include <limits>

namespace scree::contact::detail {
namespace {

using Corner = SimplexCorner;

Simplex point(const Corner& a) {
    Simplex s;
    s.corner[0] = a;
    s.corner[0].weight = 1.0;
    s.size = 1;
    return s;
}

Simplex edge(const Corner& a, const Corner& b, double weight_b) {
    Simplex s;
    s.corner[0] = a, s.corner[1] = b;
    s.corner[0].weight = 1.0 - weight_b, s.corner[1].weight = weight_b;
    s.size = 2;
    return s;
}

Simplex on_segment(const Corner& a, const Corner& b) {
    const Vec3 ab = b.w - a.w;
    const double along = -a.w.dot(ab), square = ab.squaredNorm();
    if (along <= 0.0) return point(a);
    if (along >= square) return point(b);
    return edge(a, b, along / square);
}

Simplex on_triangle(const Corner& a, const Corner& b, const Corner& c) {
    const Vec3 ab = b.w - a.w, ac = c.w - a.w;
    const double d1 = -ab.dot(a.w), d2 = -ac.dot(a.w);
    if (d1 <= 0.0 && d2 <= 0.0) return point(a);
    const double d3 = -ab.dot(b.w), d4 = -ac.dot(b.w);
    if (d3 >= 0.0 && d4 <= d3) return point(b);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return edge(a, b, d1 / (d1 - d3));
    const double d5 = -ab.dot(c.w), d6 = -ac.dot(c.w);
    if (d6 >= 0.0 && d5 <= d6) return point(c);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return edge(a, c, d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 >= d3 && d5 >= d6) return edge(b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    Simplex s;
    s.corner[0] = a, s.corner[1] = b, s.corner[2] = c;
    const double sum = va + vb + vc;
    s.corner[1].weight = vb / sum, s.corner[2].weight = vc / sum;
    s.corner[0].weight = va / sum;
    s.size = 3;
    return s;
}

Simplex on_tetrahedron(const std::array<Corner, 4>& p) {
    const Vec3 e1 = p[1].w - p[0].w, e2 = p[2].w - p[0].w, e3 = p[3].w - p[0].w;
    const double volume = e1.cross(e2).dot(e3);
    // A flat one has no inside: all its faces are asked.
    const bool flat = std::abs(volume) <= 1e-12 * std::sqrt(e1.squaredNorm() * e2.squaredNorm() * e3.squaredNorm());
    static constexpr std::size_t kFace[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    double least = std::numeric_limits<double>::infinity();
    Simplex best;
    for (const auto& f : kFace) {
        const Corner &a = p[f[0]], &b = p[f[1]], &c = p[f[2]];
        const Vec3 normal = (b.w - a.w).cross(c.w - a.w);
        const double origin = -normal.dot(a.w), fourth = normal.dot(p[f[3]].w - a.w);
        if (!flat && origin * fourth >= 0.0) continue;
        const Simplex s = on_triangle(a, b, c);
        const double square = s.nearest().squaredNorm();
        if (square < least) least = square, best = s;
    }
    if (best.size == 0) best.holds_origin = true;
    return best;
}

}  // namespace

void Simplex::reduce() {
    if (size == 1) corner[0].weight = 1.0;
    if (size == 2) *this = on_segment(corner[0], corner[1]);
    if (size == 3) *this = on_triangle(corner[0], corner[1], corner[2]);
    if (size == 4) *this = on_tetrahedron(corner);
}

}  // namespace scree::contact::detail
