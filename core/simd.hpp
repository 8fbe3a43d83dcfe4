// Eight doubles or sixteen floats side by side, whatever the machine: 64 bytes in one register with AVX-512, two with
// AVX, four with SSE2, an array elsewhere. As many lanes everywhere, no fused multiply-add: the same operations in the
// same order, so the same bits, on every width.
#pragma once

#include "core/simd_native.hpp"

namespace scree {

template <class Real>
struct PackOf {
    static constexpr int kLanes = 64 / sizeof(Real);
    static constexpr int kWidth = detail::Native<Real>::kWidth;
    static constexpr int kNatives = kLanes / kWidth;
    typename detail::Native<Real>::Type v[kNatives];

    // `p` is aligned to 64 bytes.
    static PackOf load(const Real* p) {
        PackOf r;
        for (int i = 0; i < kNatives; ++i) r.v[i] = detail::load(p + i * kWidth);
        return r;
    }
    // `p` is aligned as a number is; doubles only.
    static PackOf load_anywhere(const Real* p) {
        PackOf r;
        for (int i = 0; i < kNatives; ++i) r.v[i] = detail::load_anywhere(p + i * kWidth);
        return r;
    }
    static PackOf all(Real x) {
        PackOf r;
        for (int i = 0; i < kNatives; ++i) r.v[i] = detail::fill(x);
        return r;
    }
    void store(Real* p) const {
        for (int i = 0; i < kNatives; ++i) detail::store(p + i * kWidth, v[i]);
    }
};
using Pack = PackOf<double>;
using PackF = PackOf<float>;

#define SCREE_PACK_BINARY(op)                                                       \
    template <class Real>                                                           \
    inline PackOf<Real> operator op(const PackOf<Real>& a, const PackOf<Real>& b) { \
        PackOf<Real> r;                                                             \
        for (int i = 0; i < PackOf<Real>::kNatives; ++i) r.v[i] = a.v[i] op b.v[i]; \
        return r;                                                                   \
    }
SCREE_PACK_BINARY(+)
SCREE_PACK_BINARY(-)
SCREE_PACK_BINARY(*)
SCREE_PACK_BINARY(/)
#undef SCREE_PACK_BINARY

template <class Real>
inline PackOf<Real> max(const PackOf<Real>& a, const PackOf<Real>& b) {
    PackOf<Real> r;
    for (int i = 0; i < PackOf<Real>::kNatives; ++i) r.v[i] = detail::larger(a.v[i], b.v[i]);
    return r;
}
template <class Real>
inline PackOf<Real> min(const PackOf<Real>& a, const PackOf<Real>& b) {
    PackOf<Real> r;
    for (int i = 0; i < PackOf<Real>::kNatives; ++i) r.v[i] = detail::smaller(a.v[i], b.v[i]);
    return r;
}
template <class Real>
inline PackOf<Real> sqrt(const PackOf<Real>& a) {
    PackOf<Real> r;
    for (int i = 0; i < PackOf<Real>::kNatives; ++i) r.v[i] = detail::root(a.v[i]);
    return r;
}
// a < b ? yes : no, lane by lane
template <class Real>
inline PackOf<Real> where_less(const PackOf<Real>& a, const PackOf<Real>& b, const PackOf<Real>& yes,
                               const PackOf<Real>& no) {
    PackOf<Real> r;
    for (int i = 0; i < PackOf<Real>::kNatives; ++i) r.v[i] = detail::where_less(a.v[i], b.v[i], yes.v[i], no.v[i]);
    return r;
}
// Bit i: whether a <= b in lane i. A NaN is not.
inline std::uint32_t mask_less_equal(const Pack& a, const Pack& b) {
    std::uint32_t bits = 0;
    for (int i = 0; i < Pack::kNatives; ++i) bits |= detail::mask_less_equal(a.v[i], b.v[i]) << (i * Pack::kWidth);
    return bits;
}
// Whether a < b in some lane: to leave out work that no lane needs, never to choose a lane's result.
template <class Real>
inline bool any_less(const PackOf<Real>& a, const PackOf<Real>& b) {
    for (int i = 0; i < PackOf<Real>::kNatives; ++i)
        if (detail::any_less(a.v[i], b.v[i])) return true;
    return false;
}
// Sums of eight numbers and maxima over the lanes, in a fixed order.
inline double sum_of_eight(const auto* x) {
    const auto at = [x](int i) { return static_cast<double>(x[i]); };
    return ((at(0) + at(1)) + (at(2) + at(3))) + ((at(4) + at(5)) + (at(6) + at(7)));
}
inline double sum_lanes(const Pack& a) {
    alignas(64) double x[kLanes];
    a.store(x);
    return sum_of_eight(x);
}
template <class Real>
inline double max_lanes(const PackOf<Real>& a) {
    alignas(64) Real x[PackOf<Real>::kLanes];
    a.store(x);
    Real m = x[0];
    for (const Real y : x) m = y > m ? y : m;
    return static_cast<double>(m);
}

template <class Real>
struct Pack3Of {
    PackOf<Real> x, y, z;
};
using Pack3 = Pack3Of<double>;

template <class Real>
inline Pack3Of<Real> operator+(const Pack3Of<Real>& a, const Pack3Of<Real>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
inline Pack3Of<Real> operator-(const Pack3Of<Real>& a, const Pack3Of<Real>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
inline Pack3Of<Real> operator*(const PackOf<Real>& s, const Pack3Of<Real>& a) {
    return {s * a.x, s * a.y, s * a.z};
}
template <class Real>
inline PackOf<Real> dot(const Pack3Of<Real>& a, const Pack3Of<Real>& b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class Real>
inline Pack3Of<Real> cross(const Pack3Of<Real>& a, const Pack3Of<Real>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace scree
