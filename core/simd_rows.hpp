// Rows of four numbers, one row a lane, turned into four packs and back: how a batch reads and writes its bodies.
// `row(i)` gives the address of lane i's row, aligned to its size.
#pragma once

#include <type_traits>

#include "core/simd.hpp"

namespace scree {

namespace detail {
template <class Real, class Row>
void gather_one_by_one(const Row& row, PackOf<Real>& c0, PackOf<Real>& c1, PackOf<Real>& c2, PackOf<Real>& c3) {
    alignas(64) Real t[4][PackOf<Real>::kLanes];
    for (int i = 0; i < PackOf<Real>::kLanes; ++i)
        for (int c = 0; c < 4; ++c) t[c][i] = row(i)[c];
    c0 = PackOf<Real>::load(t[0]);
    c1 = PackOf<Real>::load(t[1]);
    c2 = PackOf<Real>::load(t[2]);
    c3 = PackOf<Real>::load(t[3]);
}
template <class Real, class Row>
void scatter_one_by_one(const Row& row, const PackOf<Real>& c0, const PackOf<Real>& c1, const PackOf<Real>& c2,
                        const PackOf<Real>& c3) {
    alignas(64) Real t[4][PackOf<Real>::kLanes];
    c0.store(t[0]);
    c1.store(t[1]);
    c2.store(t[2]);
    c3.store(t[3]);
    for (int i = 0; i < PackOf<Real>::kLanes; ++i)
        for (int c = 0; c < 4; ++c) row(i)[c] = t[c][i];
}
}  // namespace detail

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
    detail::gather_one_by_one(row, c0, c1, c2, c3);
#endif
}
#if defined(__AVX512F__)
namespace detail {
// Transposes the 4 x 4 numbers in each quarter of four registers.
struct Quarters {
    __m512 c[4];
};
SCREE_INLINE Quarters transpose(__m512 r0, __m512 r1, __m512 r2, __m512 r3) {
    const __m512 a = _mm512_maskz_unpacklo_ps(0xffff, r0, r1), b = _mm512_maskz_unpackhi_ps(0xffff, r0, r1);
    const __m512 c = _mm512_maskz_unpacklo_ps(0xffff, r2, r3), d = _mm512_maskz_unpackhi_ps(0xffff, r2, r3);
    return {{_mm512_maskz_shuffle_ps(0xffff, a, c, 0x44), _mm512_maskz_shuffle_ps(0xffff, a, c, 0xee),
             _mm512_maskz_shuffle_ps(0xffff, b, d, 0x44), _mm512_maskz_shuffle_ps(0xffff, b, d, 0xee)}};
}
}  // namespace detail
#endif

template <class Row>
SCREE_INLINE void gather4(const Row& row, PackF& c0, PackF& c1, PackF& c2, PackF& c3) {
#if defined(__AVX512F__)
    const auto four = [&](int i) {
        __m512 r = _mm512_castps128_ps512(_mm_load_ps(row(i)));
        r = _mm512_maskz_insertf32x4(0xffff, r, _mm_load_ps(row(i + 4)), 1);
        r = _mm512_maskz_insertf32x4(0xffff, r, _mm_load_ps(row(i + 8)), 2);
        return _mm512_maskz_insertf32x4(0xffff, r, _mm_load_ps(row(i + 12)), 3);
    };
    const detail::Quarters q = detail::transpose(four(0), four(1), four(2), four(3));
    c0.v[0] = q.c[0];
    c1.v[0] = q.c[1];
    c2.v[0] = q.c[2];
    c3.v[0] = q.c[3];
#elif defined(__AVX__)
    for (int g = 0; g < 2; ++g) {
        // lanes 0 to 3 in the lower halves, 4 to 7 in the upper ones
        const auto pair = [&](int i) {
            return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(row(8 * g + i))),
                                        _mm_load_ps(row(8 * g + i + 4)), 1);
        };
        const __m256 r0 = pair(0), r1 = pair(1), r2 = pair(2), r3 = pair(3);
        const __m256 xy01 = _mm256_unpacklo_ps(r0, r1), zw01 = _mm256_unpackhi_ps(r0, r1);
        const __m256 xy23 = _mm256_unpacklo_ps(r2, r3), zw23 = _mm256_unpackhi_ps(r2, r3);
        c0.v[g] = _mm256_shuffle_ps(xy01, xy23, 0x44);
        c1.v[g] = _mm256_shuffle_ps(xy01, xy23, 0xee);
        c2.v[g] = _mm256_shuffle_ps(zw01, zw23, 0x44);
        c3.v[g] = _mm256_shuffle_ps(zw01, zw23, 0xee);
    }
#else
    detail::gather_one_by_one(row, c0, c1, c2, c3);
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
    detail::scatter_one_by_one(row, c0, c1, c2, c3);
#endif
}
template <class Row>
SCREE_INLINE void scatter4(const Row& row, const PackF& c0, const PackF& c1, const PackF& c2, const PackF& c3) {
#if defined(__AVX512F__)
    const detail::Quarters q = detail::transpose(c0.v[0], c1.v[0], c2.v[0], c3.v[0]);
    for (int i = 0; i < 4; ++i) {
        _mm_store_ps(row(i), _mm512_maskz_extractf32x4_ps(0xf, q.c[i], 0));
        _mm_store_ps(row(i + 4), _mm512_maskz_extractf32x4_ps(0xf, q.c[i], 1));
        _mm_store_ps(row(i + 8), _mm512_maskz_extractf32x4_ps(0xf, q.c[i], 2));
        _mm_store_ps(row(i + 12), _mm512_maskz_extractf32x4_ps(0xf, q.c[i], 3));
    }
#elif defined(__AVX__)
    for (int g = 0; g < 2; ++g) {
        const __m256 xy01 = _mm256_unpacklo_ps(c0.v[g], c1.v[g]), xy23 = _mm256_unpackhi_ps(c0.v[g], c1.v[g]);
        const __m256 zw01 = _mm256_unpacklo_ps(c2.v[g], c3.v[g]), zw23 = _mm256_unpackhi_ps(c2.v[g], c3.v[g]);
        const auto put = [&](int i, const __m256 r) {
            _mm_store_ps(row(8 * g + i), _mm256_castps256_ps128(r));
            _mm_store_ps(row(8 * g + i + 4), _mm256_extractf128_ps(r, 1));
        };
        put(0, _mm256_shuffle_ps(xy01, zw01, 0x44));
        put(1, _mm256_shuffle_ps(xy01, zw01, 0xee));
        put(2, _mm256_shuffle_ps(xy23, zw23, 0x44));
        put(3, _mm256_shuffle_ps(xy23, zw23, 0xee));
    }
#else
    detail::scatter_one_by_one(row, c0, c1, c2, c3);
#endif
}

// The same with rows of eight numbers, into two times four packs.
template <class Real, class Row>
SCREE_INLINE void gather8(const Row& row, PackOf<Real> (&c)[8]) {
#if defined(__AVX512F__)
    if constexpr (std::is_same_v<Real, float>) {
        const auto pair = [&](int i) {
            const __m512d low = _mm512_castps_pd(_mm512_castps256_ps512(_mm256_load_ps(row(i))));
            return _mm512_castpd_ps(
                _mm512_maskz_insertf64x4(0xff, low, _mm256_castps_pd(_mm256_load_ps(row(i + 4))), 1));
        };
        // quarters: first halves of rows 0-3, second halves of them, first halves of 4-7, second halves; 8-15 alike
        const detail::Quarters p = detail::transpose(pair(0), pair(1), pair(2), pair(3));
        const detail::Quarters q = detail::transpose(pair(8), pair(9), pair(10), pair(11));
        for (int k = 0; k < 4; ++k) {
            c[k].v[0] = _mm512_maskz_shuffle_f32x4(0xffff, p.c[k], q.c[k], 0x88);
            c[k + 4].v[0] = _mm512_maskz_shuffle_f32x4(0xffff, p.c[k], q.c[k], 0xdd);
        }
        return;
    }
#endif
    gather4(row, c[0], c[1], c[2], c[3]);
    gather4([&](int i) { return row(i) + 4; }, c[4], c[5], c[6], c[7]);
}
template <class Real, class Row>
SCREE_INLINE void scatter8(const Row& row, const PackOf<Real> (&c)[8]) {
#if defined(__AVX512F__)
    if constexpr (std::is_same_v<Real, float>) {
        const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
        const __m512i second = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
        const auto half = [&](int k, __m512i which) {
            return _mm512_castpd_ps(
                _mm512_permutex2var_pd(_mm512_castps_pd(c[k].v[0]), which, _mm512_castps_pd(c[k + 4].v[0])));
        };
        const auto put = [&](int at, __m512i which) {
            const detail::Quarters q =
                detail::transpose(half(0, which), half(1, which), half(2, which), half(3, which));
            for (int i = 0; i < 4; ++i) {
                const __m512d r = _mm512_castps_pd(q.c[i]);
                _mm256_store_ps(row(at + i), _mm256_castpd_ps(_mm512_maskz_extractf64x4_pd(0xf, r, 0)));
                _mm256_store_ps(row(at + i + 4), _mm256_castpd_ps(_mm512_maskz_extractf64x4_pd(0xf, r, 1)));
            }
        };
        put(0, first);
        put(8, second);
        return;
    }
#endif
    scatter4(row, c[0], c[1], c[2], c[3]);
    scatter4([&](int i) { return row(i) + 4; }, c[4], c[5], c[6], c[7]);
}

}  // namespace scree
