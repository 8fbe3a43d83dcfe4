// Registers of doubles and of floats under one set of names, so that a pack (core/simd.hpp) is written once.
#pragma once

#include <cmath>
#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace scree {

inline constexpr int kLanes = 8;         // of doubles
inline constexpr int kLanesSingle = 16;  // of floats: as many bytes

// Kernels keep their packs in registers only if every helper is inlined.
#define SCREE_INLINE [[gnu::always_inline]] inline

namespace detail {

// Type: the longest register; kWidth: how many numbers it holds.
template <class Real>
struct Native;

#if defined(__AVX512F__)
template <>
struct Native<double> {
    using Type = __m512d;
    static constexpr int kWidth = 8;
};
inline __m512d load(const double* p) {
    return _mm512_load_pd(p);
}
inline void store(double* p, __m512d a) {
    _mm512_store_pd(p, a);
}
inline __m512d fill(double x) {
    return _mm512_set1_pd(x);
}
// The masked forms: GCC 12 warns of the undefined pass-through operand in the plain ones.
inline __m512d root(__m512d a) {
    return _mm512_maskz_sqrt_pd(0xff, a);
}
inline __m512d larger(__m512d a, __m512d b) {
    return _mm512_maskz_max_pd(0xff, a, b);
}
inline __m512d smaller(__m512d a, __m512d b) {
    return _mm512_maskz_min_pd(0xff, a, b);
}
inline __m512d where_less(__m512d a, __m512d b, __m512d yes, __m512d no) {
    return _mm512_mask_blend_pd(_mm512_cmp_pd_mask(a, b, _CMP_LT_OQ), no, yes);
}
inline __m512d load_anywhere(const double* p) {
    return _mm512_loadu_pd(p);
}
inline std::uint32_t mask_less_equal(__m512d a, __m512d b) {
    return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ);
}
inline bool any_less(__m512d a, __m512d b) {
    return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ) != 0;
}
#elif defined(__AVX__)
template <>
struct Native<double> {
    using Type = __m256d;
    static constexpr int kWidth = 4;
};
inline __m256d load(const double* p) {
    return _mm256_load_pd(p);
}
inline void store(double* p, __m256d a) {
    _mm256_store_pd(p, a);
}
inline __m256d fill(double x) {
    return _mm256_set1_pd(x);
}
inline __m256d root(__m256d a) {
    return _mm256_sqrt_pd(a);
}
inline __m256d larger(__m256d a, __m256d b) {
    return _mm256_max_pd(a, b);
}
inline __m256d smaller(__m256d a, __m256d b) {
    return _mm256_min_pd(a, b);
}
inline __m256d where_less(__m256d a, __m256d b, __m256d yes, __m256d no) {
    return _mm256_blendv_pd(no, yes, _mm256_cmp_pd(a, b, _CMP_LT_OQ));
}
inline __m256d load_anywhere(const double* p) {
    return _mm256_loadu_pd(p);
}
inline std::uint32_t mask_less_equal(__m256d a, __m256d b) {
    return static_cast<std::uint32_t>(_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LE_OQ)));
}
inline bool any_less(__m256d a, __m256d b) {
    return _mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LT_OQ)) != 0;
}
#elif defined(__SSE2__)
template <>
struct Native<double> {
    using Type = __m128d;
    static constexpr int kWidth = 2;
};
inline __m128d load(const double* p) {
    return _mm_load_pd(p);
}
inline void store(double* p, __m128d a) {
    _mm_store_pd(p, a);
}
inline __m128d fill(double x) {
    return _mm_set1_pd(x);
}
inline __m128d root(__m128d a) {
    return _mm_sqrt_pd(a);
}
inline __m128d larger(__m128d a, __m128d b) {
    return _mm_max_pd(a, b);
}
inline __m128d smaller(__m128d a, __m128d b) {
    return _mm_min_pd(a, b);
}
inline __m128d where_less(__m128d a, __m128d b, __m128d yes, __m128d no) {
    const __m128d mask = _mm_cmplt_pd(a, b);
    return _mm_or_pd(_mm_and_pd(mask, yes), _mm_andnot_pd(mask, no));
}
inline __m128d load_anywhere(const double* p) {
    return _mm_loadu_pd(p);
}
inline std::uint32_t mask_less_equal(__m128d a, __m128d b) {
    return static_cast<std::uint32_t>(_mm_movemask_pd(_mm_cmple_pd(a, b)));
}
inline bool any_less(__m128d a, __m128d b) {
    return _mm_movemask_pd(_mm_cmplt_pd(a, b)) != 0;
}
#endif

#if defined(__AVX512F__)
template <>
struct Native<float> {
    using Type = __m512;
    static constexpr int kWidth = 16;
};
inline __m512 load(const float* p) {
    return _mm512_load_ps(p);
}
inline void store(float* p, __m512 a) {
    _mm512_store_ps(p, a);
}
inline __m512 fill(float x) {
    return _mm512_set1_ps(x);
}
inline __m512 root(__m512 a) {
    return _mm512_maskz_sqrt_ps(0xffff, a);
}
inline __m512 larger(__m512 a, __m512 b) {
    return _mm512_maskz_max_ps(0xffff, a, b);
}
inline __m512 smaller(__m512 a, __m512 b) {
    return _mm512_maskz_min_ps(0xffff, a, b);
}
inline __m512 where_less(__m512 a, __m512 b, __m512 yes, __m512 no) {
    return _mm512_mask_blend_ps(_mm512_cmp_ps_mask(a, b, _CMP_LT_OQ), no, yes);
}
inline bool any_less(__m512 a, __m512 b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ) != 0;
}
#elif defined(__AVX__)
template <>
struct Native<float> {
    using Type = __m256;
    static constexpr int kWidth = 8;
};
inline __m256 load(const float* p) {
    return _mm256_load_ps(p);
}
inline void store(float* p, __m256 a) {
    _mm256_store_ps(p, a);
}
inline __m256 fill(float x) {
    return _mm256_set1_ps(x);
}
inline __m256 root(__m256 a) {
    return _mm256_sqrt_ps(a);
}
inline __m256 larger(__m256 a, __m256 b) {
    return _mm256_max_ps(a, b);
}
inline __m256 smaller(__m256 a, __m256 b) {
    return _mm256_min_ps(a, b);
}
inline __m256 where_less(__m256 a, __m256 b, __m256 yes, __m256 no) {
    return _mm256_blendv_ps(no, yes, _mm256_cmp_ps(a, b, _CMP_LT_OQ));
}
inline bool any_less(__m256 a, __m256 b) {
    return _mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LT_OQ)) != 0;
}
#elif defined(__SSE2__)
template <>
struct Native<float> {
    using Type = __m128;
    static constexpr int kWidth = 4;
};
inline __m128 load(const float* p) {
    return _mm_load_ps(p);
}
inline void store(float* p, __m128 a) {
    _mm_store_ps(p, a);
}
inline __m128 fill(float x) {
    return _mm_set1_ps(x);
}
inline __m128 root(__m128 a) {
    return _mm_sqrt_ps(a);
}
inline __m128 larger(__m128 a, __m128 b) {
    return _mm_max_ps(a, b);
}
inline __m128 smaller(__m128 a, __m128 b) {
    return _mm_min_ps(a, b);
}
inline __m128 where_less(__m128 a, __m128 b, __m128 yes, __m128 no) {
    const __m128 mask = _mm_cmplt_ps(a, b);
    return _mm_or_ps(_mm_and_ps(mask, yes), _mm_andnot_ps(mask, no));
}
inline bool any_less(__m128 a, __m128 b) {
    return _mm_movemask_ps(_mm_cmplt_ps(a, b)) != 0;
}
#else
template <class Real>
struct Native {
    using Type = Real;
    static constexpr int kWidth = 1;
};
template <class Real>
Real load(const Real* p) {
    return *p;
}
template <class Real>
void store(Real* p, Real a) {
    *p = a;
}
template <class Real>
Real fill(Real x) {
    return x;
}
template <class Real>
Real root(Real a) {
    return std::sqrt(a);
}
template <class Real>
Real larger(Real a, Real b) {
    return a > b ? a : b;
}
template <class Real>
Real smaller(Real a, Real b) {
    return a < b ? a : b;
}
template <class Real>
Real where_less(Real a, Real b, Real yes, Real no) {
    return a < b ? yes : no;
}
template <class Real>
Real load_anywhere(const Real* p) {
    return *p;
}
template <class Real>
std::uint32_t mask_less_equal(Real a, Real b) {
    return a <= b ? 1 : 0;
}
template <class Real>
bool any_less(Real a, Real b) {
    return a < b;
}
#endif

}  // namespace detail

inline const char* simd_name() {
    constexpr int width = detail::Native<double>::kWidth;
    return width == 8 ? "AVX-512" : width == 4 ? "AVX" : width == 2 ? "SSE2" : "scalar";
}

}  // namespace scree
