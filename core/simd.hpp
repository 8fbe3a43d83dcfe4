// Eight doubles side by side, whatever the machine: one register with AVX-512, two with AVX, four with SSE2, an array
// elsewhere. Eight lanes everywhere, no fused multiply-add: the same operations in the same order, so the same bits,
// on every width.
#pragma once

#include <cmath>
#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace scree {

inline constexpr int kLanes = 8;

// Kernels keep their packs in registers only if every helper is inlined.
#define SCREE_INLINE [[gnu::always_inline]] inline

#if defined(__AVX512F__)
inline constexpr int kNativeLanes = 8;
using Native = __m512d;
#elif defined(__AVX__)
inline constexpr int kNativeLanes = 4;
using Native = __m256d;
#elif defined(__SSE2__)
inline constexpr int kNativeLanes = 2;
using Native = __m128d;
#else
inline constexpr int kNativeLanes = 1;
using Native = double;
#endif
inline constexpr int kNatives = kLanes / kNativeLanes;

inline const char* simd_name() {
    return kNativeLanes == 8 ? "AVX-512" : kNativeLanes == 4 ? "AVX" : kNativeLanes == 2 ? "SSE2" : "scalar";
}

namespace detail {
#if defined(__AVX512F__)
inline Native load(const double* p) {
    return _mm512_load_pd(p);
}
inline void store(double* p, Native a) {
    _mm512_store_pd(p, a);
}
inline Native fill(double x) {
    return _mm512_set1_pd(x);
}
// The masked forms: GCC 12 warns of the undefined pass-through operand in the plain ones.
inline Native root(Native a) {
    return _mm512_maskz_sqrt_pd(0xff, a);
}
inline Native larger(Native a, Native b) {
    return _mm512_maskz_max_pd(0xff, a, b);
}
inline Native smaller(Native a, Native b) {
    return _mm512_maskz_min_pd(0xff, a, b);
}
inline Native where_less(Native a, Native b, Native yes, Native no) {
    return _mm512_mask_blend_pd(_mm512_cmp_pd_mask(a, b, _CMP_LT_OQ), no, yes);
}
#elif defined(__AVX__)
inline Native load(const double* p) {
    return _mm256_load_pd(p);
}
inline void store(double* p, Native a) {
    _mm256_store_pd(p, a);
}
inline Native fill(double x) {
    return _mm256_set1_pd(x);
}
inline Native root(Native a) {
    return _mm256_sqrt_pd(a);
}
inline Native larger(Native a, Native b) {
    return _mm256_max_pd(a, b);
}
inline Native smaller(Native a, Native b) {
    return _mm256_min_pd(a, b);
}
inline Native where_less(Native a, Native b, Native yes, Native no) {
    return _mm256_blendv_pd(no, yes, _mm256_cmp_pd(a, b, _CMP_LT_OQ));
}
#elif defined(__SSE2__)
inline Native load(const double* p) {
    return _mm_load_pd(p);
}
inline void store(double* p, Native a) {
    _mm_store_pd(p, a);
}
inline Native fill(double x) {
    return _mm_set1_pd(x);
}
inline Native root(Native a) {
    return _mm_sqrt_pd(a);
}
inline Native larger(Native a, Native b) {
    return _mm_max_pd(a, b);
}
inline Native smaller(Native a, Native b) {
    return _mm_min_pd(a, b);
}
inline Native where_less(Native a, Native b, Native yes, Native no) {
    const Native mask = _mm_cmplt_pd(a, b);
    return _mm_or_pd(_mm_and_pd(mask, yes), _mm_andnot_pd(mask, no));
}
#else
inline Native load(const double* p) {
    return *p;
}
inline void store(double* p, Native a) {
    *p = a;
}
inline Native fill(double x) {
    return x;
}
inline Native root(Native a) {
    return std::sqrt(a);
}
inline Native larger(Native a, Native b) {
    return a > b ? a : b;
}
inline Native smaller(Native a, Native b) {
    return a < b ? a : b;
}
inline Native where_less(Native a, Native b, Native yes, Native no) {
    return a < b ? yes : no;
}
#endif
}  // namespace detail

struct Pack {
    Native v[kNatives];

    // `p` is aligned to 64 bytes.
    static Pack load(const double* p) {
        Pack r;
        for (int i = 0; i < kNatives; ++i) r.v[i] = detail::load(p + i * kNativeLanes);
        return r;
    }
    static Pack all(double x) {
        Pack r;
        for (int i = 0; i < kNatives; ++i) r.v[i] = detail::fill(x);
        return r;
    }
    void store(double* p) const {
        for (int i = 0; i < kNatives; ++i) detail::store(p + i * kNativeLanes, v[i]);
    }
};

#define SCREE_PACK_BINARY(op)                                         \
    inline Pack operator op(const Pack& a, const Pack& b) {           \
        Pack r;                                                       \
        for (int i = 0; i < kNatives; ++i) r.v[i] = a.v[i] op b.v[i]; \
        return r;                                                     \
    }
SCREE_PACK_BINARY(+)
SCREE_PACK_BINARY(-)
SCREE_PACK_BINARY(*)
SCREE_PACK_BINARY(/)
#undef SCREE_PACK_BINARY

inline Pack max(const Pack& a, const Pack& b) {
    Pack r;
    for (int i = 0; i < kNatives; ++i) r.v[i] = detail::larger(a.v[i], b.v[i]);
    return r;
}
inline Pack min(const Pack& a, const Pack& b) {
    Pack r;
    for (int i = 0; i < kNatives; ++i) r.v[i] = detail::smaller(a.v[i], b.v[i]);
    return r;
}
inline Pack sqrt(const Pack& a) {
    Pack r;
    for (int i = 0; i < kNatives; ++i) r.v[i] = detail::root(a.v[i]);
    return r;
}
// a < b ? yes : no, lane by lane
inline Pack where_less(const Pack& a, const Pack& b, const Pack& yes, const Pack& no) {
    Pack r;
    for (int i = 0; i < kNatives; ++i) r.v[i] = detail::where_less(a.v[i], b.v[i], yes.v[i], no.v[i]);
    return r;
}
// Sum and maximum over the lanes, in a fixed order.
inline double sum_lanes(const Pack& a) {
    alignas(64) double x[kLanes];
    a.store(x);
    return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
}
inline double max_lanes(const Pack& a) {
    alignas(64) double x[kLanes];
    a.store(x);
    double m = x[0];
    for (int i = 1; i < kLanes; ++i) m = x[i] > m ? x[i] : m;
    return m;
}

struct Pack3 {
    Pack x, y, z;
};
inline Pack3 operator+(const Pack3& a, const Pack3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Pack3 operator-(const Pack3& a, const Pack3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Pack3 operator*(const Pack& s, const Pack3& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline Pack dot(const Pack3& a, const Pack3& b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
inline Pack3 cross(const Pack3& a, const Pack3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Four rows of four doubles, one row a lane, turned into four packs and back. `row(i)` gives the address (aligned to 32
// bytes) of lane i's row.
template <class Row>
SCREE_INLINE void gather4(const Row& row, Pack& c0, Pack& c1, Pack& c2, Pack& c3) {
#if defined(__AVX512F__)
    // pairs of rows (0,2) (1,3) (4,6) (5,7), so that the lanes come out in order
    const auto pair = [&](int i, int j) {
        return _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(_mm256_load_pd(row(i))), _mm256_load_pd(row(j)),
                                        1);
    };
    const __m512d r0 = pair(0, 2), r1 = pair(1, 3), r2 = pair(4, 6), r3 = pair(5, 7);
    const __m512d xz0 = _mm512_maskz_unpacklo_pd(0xff, r0, r1), yw0 = _mm512_maskz_unpackhi_pd(0xff, r0, r1);
    const __m512d xz1 = _mm512_maskz_unpacklo_pd(0xff, r2, r3), yw1 = _mm512_maskz_unpackhi_pd(0xff, r2, r3);
    c0.v[0] = _mm512_maskz_shuffle_f64x2(0xff, xz0, xz1, 0x88);
    c1.v[0] = _mm512_maskz_shuffle_f64x2(0xff, yw0, yw1, 0x88);
    c2.v[0] = _mm512_maskz_shuffle_f64x2(0xff, xz0, xz1, 0xdd);
    c3.v[0] = _mm512_maskz_shuffle_f64x2(0xff, yw0, yw1, 0xdd);
#elif defined(__AVX__)
    for (int g = 0; g < 2; ++g) {
        const __m256d r0 = _mm256_load_pd(row(4 * g)), r1 = _mm256_load_pd(row(4 * g + 1));
        const __m256d r2 = _mm256_load_pd(row(4 * g + 2)), r3 = _mm256_load_pd(row(4 * g + 3));
        const __m256d xz0 = _mm256_unpacklo_pd(r0, r1), yw0 = _mm256_unpackhi_pd(r0, r1);
        const __m256d xz1 = _mm256_unpacklo_pd(r2, r3), yw1 = _mm256_unpackhi_pd(r2, r3);
        c0.v[g] = _mm256_permute2f128_pd(xz0, xz1, 0x20);
        c1.v[g] = _mm256_permute2f128_pd(yw0, yw1, 0x20);
        c2.v[g] = _mm256_permute2f128_pd(xz0, xz1, 0x31);
        c3.v[g] = _mm256_permute2f128_pd(yw0, yw1, 0x31);
    }
#else
    alignas(64) double t[4][kLanes];
    for (int i = 0; i < kLanes; ++i)
        for (int c = 0; c < 4; ++c) t[c][i] = row(i)[c];
    c0 = Pack::load(t[0]);
    c1 = Pack::load(t[1]);
    c2 = Pack::load(t[2]);
    c3 = Pack::load(t[3]);
#endif
}
template <class Row>
SCREE_INLINE void scatter4(const Row& row, const Pack& c0, const Pack& c1, const Pack& c2, const Pack& c3) {
#if defined(__AVX512F__)
    const __m512d lo01 = _mm512_maskz_unpacklo_pd(0xff, c0.v[0], c1.v[0]);  // x y of lanes 0 | 2 | 4 | 6
    const __m512d hi01 = _mm512_maskz_unpackhi_pd(0xff, c0.v[0], c1.v[0]);  // of lanes 1 | 3 | 5 | 7
    const __m512d lo23 = _mm512_maskz_unpacklo_pd(0xff, c2.v[0], c3.v[0]);
    const __m512d hi23 = _mm512_maskz_unpackhi_pd(0xff, c2.v[0], c3.v[0]);
    const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
    const __m512i high = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
    const auto put = [&](int i, int j, const __m512d r) {
        _mm256_store_pd(row(i), _mm512_maskz_extractf64x4_pd(0xf, r, 0));
        _mm256_store_pd(row(j), _mm512_maskz_extractf64x4_pd(0xf, r, 1));
    };
    put(0, 2, _mm512_permutex2var_pd(lo01, low, lo23));
    put(4, 6, _mm512_permutex2var_pd(lo01, high, lo23));
    put(1, 3, _mm512_permutex2var_pd(hi01, low, hi23));
    put(5, 7, _mm512_permutex2var_pd(hi01, high, hi23));
#elif defined(__AVX__)
    for (int g = 0; g < 2; ++g) {
        const __m256d lo01 = _mm256_unpacklo_pd(c0.v[g], c1.v[g]), hi01 = _mm256_unpackhi_pd(c0.v[g], c1.v[g]);
        const __m256d lo23 = _mm256_unpacklo_pd(c2.v[g], c3.v[g]), hi23 = _mm256_unpackhi_pd(c2.v[g], c3.v[g]);
        _mm256_store_pd(row(4 * g), _mm256_permute2f128_pd(lo01, lo23, 0x20));
        _mm256_store_pd(row(4 * g + 1), _mm256_permute2f128_pd(hi01, hi23, 0x20));
        _mm256_store_pd(row(4 * g + 2), _mm256_permute2f128_pd(lo01, lo23, 0x31));
        _mm256_store_pd(row(4 * g + 3), _mm256_permute2f128_pd(hi01, hi23, 0x31));
    }
#else
    alignas(64) double t[4][kLanes];
    c0.store(t[0]);
    c1.store(t[1]);
    c2.store(t[2]);
    c3.store(t[3]);
    for (int i = 0; i < kLanes; ++i)
        for (int c = 0; c < 4; ++c) row(i)[c] = t[c][i];
#endif
}

}  // namespace scree
