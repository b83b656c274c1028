// Vector types of the instruction set's width. Every operation is exact per lane (IEEE), so that images do not depend
// on the width. Included by kernel.cc only, inside the namespace of one instruction set.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace trundle::TRUNDLE_ISA {

#if defined(__AVX512F__)
constexpr int kLanes = 16;
#elif defined(__AVX2__)
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif

typedef float Floats __attribute__((vector_size(kLanes * 4)));
typedef int32_t Ints __attribute__((vector_size(kLanes * 4)));  // also masks: 0 or -1

constexpr int kDoubleLanes = kLanes / 2;
typedef double Doubles __attribute__((vector_size(kDoubleLanes * 8)));
typedef decltype(Doubles{} < Doubles{}) Longs;

template <typename Numbers>
using Mask = decltype(Numbers{} < Numbers{});

template <typename Numbers>
struct Vector3 {
  Numbers x, y, z;
};
using Floats3 = Vector3<Floats>;
using Doubles3 = Vector3<Doubles>;

inline Floats splat(float value) { return value - Floats{}; }  // folded away, unlike a sum with zero
inline Doubles splat(double value) { return value - Doubles{}; }
inline Ints splat(int32_t value) { return Ints{} + value; }
template <typename Numbers>
inline Numbers select(Mask<Numbers> mask, Numbers yes, Numbers no) {
  return mask ? yes : no;
}
#if defined(__AVX512F__)
inline Doubles select(Longs mask, Doubles yes, Doubles no) {  // g++ would unpack some masks of doubles bit by bit
  return reinterpret_cast<Doubles>(_mm512_mask_blend_pd(_mm512_movepi64_mask(reinterpret_cast<__m512i>(mask)),
                                                        reinterpret_cast<__m512d>(no), reinterpret_cast<__m512d>(yes)));
}
#endif
inline Ints min_of(Ints a, int32_t b) { return select(a < b, a, splat(b)); }

// With a NaN, the second operand.
#if defined(__AVX512F__)
inline Floats max(Floats a, Floats b) {
  return reinterpret_cast<Floats>(_mm512_max_ps(reinterpret_cast<__m512>(a), reinterpret_cast<__m512>(b)));
}
inline Floats min(Floats a, Floats b) {
  return reinterpret_cast<Floats>(_mm512_min_ps(reinterpret_cast<__m512>(a), reinterpret_cast<__m512>(b)));
}
inline Doubles max(Doubles a, Doubles b) {
  return reinterpret_cast<Doubles>(_mm512_max_pd(reinterpret_cast<__m512d>(a), reinterpret_cast<__m512d>(b)));
}
inline Doubles min(Doubles a, Doubles b) {
  return reinterpret_cast<Doubles>(_mm512_min_pd(reinterpret_cast<__m512d>(a), reinterpret_cast<__m512d>(b)));
}
#elif defined(__AVX2__)
inline Floats max(Floats a, Floats b) {
  return reinterpret_cast<Floats>(_mm256_max_ps(reinterpret_cast<__m256>(a), reinterpret_cast<__m256>(b)));
}
inline Floats min(Floats a, Floats b) {
  return reinterpret_cast<Floats>(_mm256_min_ps(reinterpret_cast<__m256>(a), reinterpret_cast<__m256>(b)));
}
inline Doubles max(Doubles a, Doubles b) {
  return reinterpret_cast<Doubles>(_mm256_max_pd(reinterpret_cast<__m256d>(a), reinterpret_cast<__m256d>(b)));
}
inline Doubles min(Doubles a, Doubles b) {
  return reinterpret_cast<Doubles>(_mm256_min_pd(reinterpret_cast<__m256d>(a), reinterpret_cast<__m256d>(b)));
}
#elif defined(__SSE2__)
inline Floats max(Floats a, Floats b) {
  return reinterpret_cast<Floats>(_mm_max_ps(reinterpret_cast<__m128>(a), reinterpret_cast<__m128>(b)));
}
inline Floats min(Floats a, Floats b) {
  return reinterpret_cast<Floats>(_mm_min_ps(reinterpret_cast<__m128>(a), reinterpret_cast<__m128>(b)));
}
inline Doubles max(Doubles a, Doubles b) {
  return reinterpret_cast<Doubles>(_mm_max_pd(reinterpret_cast<__m128d>(a), reinterpret_cast<__m128d>(b)));
}
inline Doubles min(Doubles a, Doubles b) {
  return reinterpret_cast<Doubles>(_mm_min_pd(reinterpret_cast<__m128d>(a), reinterpret_cast<__m128d>(b)));
}
#else
template <typename Numbers>
inline Numbers max(Numbers a, Numbers b) {
  return select(a > b, a, b);
}
template <typename Numbers>
inline Numbers min(Numbers a, Numbers b) {
  return select(a < b, a, b);
}
#endif
inline Floats abs(Floats a) { return reinterpret_cast<Floats>(reinterpret_cast<Ints>(a) & 0x7fffffff); }
inline Doubles abs(Doubles a) { return reinterpret_cast<Doubles>(reinterpret_cast<Longs>(a) & 0x7fffffffffffffff); }

inline Floats sqrt(Floats a) {
  Floats root;
  for (int i = 0; i < kLanes; ++i) root[i] = __builtin_sqrtf(a[i]);
  return root;
}
inline Doubles sqrt(Doubles a) {
  Doubles root;
  for (int i = 0; i < kDoubleLanes; ++i) root[i] = __builtin_sqrt(a[i]);
  return root;
}

inline bool any(Ints mask) {
#if defined(__AVX512F__)
  return _mm512_test_epi32_mask(reinterpret_cast<__m512i>(mask), reinterpret_cast<__m512i>(mask)) != 0;
#elif defined(__AVX2__)
  return !_mm256_testz_si256(reinterpret_cast<__m256i>(mask), reinterpret_cast<__m256i>(mask));
#elif defined(__SSE2__)
  return _mm_movemask_epi8(reinterpret_cast<__m128i>(mask)) != 0;
#else
  int32_t all = 0;
  for (int i = 0; i < kLanes; ++i) all |= mask[i];
  return all != 0;
#endif
}

// One bit per lane, lane 0 lowest.
inline uint32_t bits(Ints mask) {
#if defined(__AVX512F__)
  return _mm512_movepi32_mask(reinterpret_cast<__m512i>(mask));
#elif defined(__AVX2__)
  return static_cast<uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#elif defined(__SSE2__)
  return static_cast<uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  uint32_t all = 0;
  for (int i = 0; i < kLanes; ++i) all |= (uint32_t)(mask[i] & 1) << i;
  return all;
#endif
}

// Maximum and minimum over all lanes.
inline float reduce_max(Floats a) {
#if defined(__AVX512F__)
  return _mm512_reduce_max_ps(reinterpret_cast<__m512>(a));
#elif defined(__SSE2__)
#if defined(__AVX2__)
  __m128 half = _mm_max_ps(_mm256_castps256_ps128(reinterpret_cast<__m256>(a)),
                           _mm256_extractf128_ps(reinterpret_cast<__m256>(a), 1));
#else
  __m128 half = reinterpret_cast<__m128>(a);
#endif
  half = _mm_max_ps(half, _mm_movehl_ps(half, half));
  return _mm_cvtss_f32(_mm_max_ss(half, _mm_shuffle_ps(half, half, 1)));
#else
  float largest = a[0];
  for (int i = 1; i < kLanes; ++i) largest = a[i] > largest ? a[i] : largest;
  return largest;
#endif
}
inline float reduce_min(Floats a) { return -reduce_max(-a); }

inline Floats lane_indices() {
  Floats numbers;
  for (int i = 0; i < kLanes; ++i) numbers[i] = static_cast<float>(i);
  return numbers;
}

inline Ints to_int(Floats a) { return __builtin_convertvector(a, Ints); }
inline Floats to_float(Ints a) { return __builtin_convertvector(a, Floats); }

inline Floats floor(Floats a) {
  const Floats near_zero = to_float(to_int(a));
  return near_zero - select(near_zero > a, splat(1.0f), Floats{});
}

// 2^a, relative error 2e-7, for a in [-126, 126].
inline Floats exp2(Floats a) {
  a = max(min(a, splat(126.0f)), splat(-126.0f));
  const Floats whole = floor(a), f = a - whole;
  const Floats power =
      1.0f +
      f * (0.693147182f +
           f * (0.240226462f + f * (0.0555032939f + f * (0.00961834215f + f * (0.00133987482f + f * 0.000154353f)))));
  return power * reinterpret_cast<Floats>((to_int(whole) + 127) << 23);
}

// Binary logarithm of a positive normal number, error 1e-6: 2 artanh((m - 1) / (m + 1)) / ln 2 of its mantissa m.
inline Floats log2(Floats a) {
  const Ints bits = reinterpret_cast<Ints>(a);
  const Floats exponent = to_float((bits >> 23) - 127),
               mantissa = reinterpret_cast<Floats>((bits & 0x007fffff) | 0x3f800000);
  const Floats s = (mantissa - 1.0f) / (mantissa + 1.0f), q = s * s;
  return exponent + s * (2.88539008f + q * (0.961796694f + q * (0.577078016f + q * (0.412198583f + q * 0.320598898f))));
}

// By repeated squaring for integer exponents, the usual case for highlights.
inline Floats pow(Floats a, float exponent) {
  const Ints some = a > 1e-30f;
  const int whole = exponent >= 0.0f && exponent <= 256.0f ? static_cast<int>(exponent) : -1;
  if (static_cast<float>(whole) != exponent)
    return select(some, exp2(log2(max(a, splat(1e-30f))) * exponent), Floats{});
  Floats product = splat(1.0f);
  for (int left = whole; left; left >>= 1, a *= a)
    if (left & 1) product *= a;
  return select(some, product, Floats{});
}
inline Floats load(const float* at) {
  Floats value;
  __builtin_memcpy(&value, at, sizeof value);
  return value;
}
inline Ints lane_numbers() { return __builtin_convertvector(lane_indices(), Ints); }
inline Ints load(const int32_t* at) {
  Ints value;
  __builtin_memcpy(&value, at, sizeof value);
  return value;
}
inline Floats gather(const float* from, Ints at) {
#if defined(__AVX512F__)
  return reinterpret_cast<Floats>(_mm512_i32gather_ps(reinterpret_cast<__m512i>(at), from, 4));
#elif defined(__AVX2__)
  return reinterpret_cast<Floats>(_mm256_i32gather_ps(from, reinterpret_cast<__m256i>(at), 4));
#else
  Floats value;
  for (int i = 0; i < kLanes; ++i) value[i] = from[at[i]];
  return value;
#endif
}
inline Ints gather(const int32_t* from, Ints at) {
  return reinterpret_cast<Ints>(gather(reinterpret_cast<const float*>(from), at));
}

// Four consecutive numbers per lane, from `at` on: loaded as rows and transposed, for the cost of one gather.
inline void gather_four(const float* from, Ints at, Floats four[4]) {
#if defined(__AVX2__)
  const auto row = [&](int lane) { return _mm_loadu_ps(from + static_cast<uint32_t>(at[lane])); };
  const auto rows = [&](int lane) { return _mm256_insertf128_ps(_mm256_castps128_ps256(row(lane)), row(lane + 4), 1); };
#endif
#if defined(__AVX512F__)
  __m512 r[4];
  for (int i = 0; i < 4; ++i) r[i] = _mm512_insertf32x8(_mm512_castps256_ps512(rows(i)), rows(i + 8), 1);
  const __m512 a = _mm512_unpacklo_ps(r[0], r[1]), b = _mm512_unpackhi_ps(r[0], r[1]);
  const __m512 c = _mm512_unpacklo_ps(r[2], r[3]), d = _mm512_unpackhi_ps(r[2], r[3]);
  four[0] = reinterpret_cast<Floats>(_mm512_shuffle_ps(a, c, 0x44));
  four[1] = reinterpret_cast<Floats>(_mm512_shuffle_ps(a, c, 0xee));
  four[2] = reinterpret_cast<Floats>(_mm512_shuffle_ps(b, d, 0x44));
  four[3] = reinterpret_cast<Floats>(_mm512_shuffle_ps(b, d, 0xee));
#elif defined(__AVX2__)
  const __m256 r[4] = {rows(0), rows(1), rows(2), rows(3)};
  const __m256 a = _mm256_unpacklo_ps(r[0], r[1]), b = _mm256_unpackhi_ps(r[0], r[1]);
  const __m256 c = _mm256_unpacklo_ps(r[2], r[3]), d = _mm256_unpackhi_ps(r[2], r[3]);
  four[0] = reinterpret_cast<Floats>(_mm256_shuffle_ps(a, c, 0x44));
  four[1] = reinterpret_cast<Floats>(_mm256_shuffle_ps(a, c, 0xee));
  four[2] = reinterpret_cast<Floats>(_mm256_shuffle_ps(b, d, 0x44));
  four[3] = reinterpret_cast<Floats>(_mm256_shuffle_ps(b, d, 0xee));
#else
  for (int i = 0; i < kLanes; ++i)
    for (int k = 0; k < 4; ++k) four[k][i] = from[at[i] + k];
#endif
}

// Two consecutive numbers per lane.
inline void gather_two(const int32_t* from, Ints at, Ints& first, Ints& second) {
#if defined(__AVX512F__)
  first = gather(from, at);
  second = gather(from + 1, at);
#elif defined(__AVX2__)
  __m256 pairs[2];
  for (int i = 0; i < 2; ++i) {
    const auto two = [&](int lane) {
      const __m128 pair =
          _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + static_cast<uint32_t>(at[lane]))));
      return _mm_loadh_pi(pair, reinterpret_cast<const __m64*>(from + static_cast<uint32_t>(at[lane + 1])));
    };
    pairs[i] = _mm256_insertf128_ps(_mm256_castps128_ps256(two(2 * i)), two(2 * i + 4), 1);
  }
  first = reinterpret_cast<Ints>(_mm256_shuffle_ps(pairs[0], pairs[1], 0x88));
  second = reinterpret_cast<Ints>(_mm256_shuffle_ps(pairs[0], pairs[1], 0xdd));
#else
  for (int i = 0; i < kLanes; ++i) {
    first[i] = from[at[i]];
    second[i] = from[at[i] + 1];
  }
#endif
}
inline Doubles load(const double* at) {
  Doubles value;
  __builtin_memcpy(&value, at, sizeof value);
  return value;
}
inline void store(double* at, Doubles value) { __builtin_memcpy(at, &value, sizeof value); }
inline void store(float* at, Floats value) { __builtin_memcpy(at, &value, sizeof value); }
inline void store(int32_t* at, Ints value) { __builtin_memcpy(at, &value, sizeof value); }

template <typename Numbers>
inline Numbers dot(const Vector3<Numbers>& a, const Vector3<Numbers>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename Numbers>
inline Vector3<Numbers> operator+(const Vector3<Numbers>& a, const Vector3<Numbers>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <typename Numbers>
inline Vector3<Numbers> operator*(const Vector3<Numbers>& a, Numbers s) {
  return {a.x * s, a.y * s, a.z * s};
}
inline Floats3 splat(const float* v) { return {splat(v[0]), splat(v[1]), splat(v[2])}; }
inline Doubles3 splat(const double* v) { return {splat(v[0]), splat(v[1]), splat(v[2])}; }

// Row-major rotation matrix times a vector, and its inverse times a vector.
template <typename Number, typename Numbers>
inline Vector3<Numbers> rotate(const Number* m, const Vector3<Numbers>& v) {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
          m[6] * v.x + m[7] * v.y + m[8] * v.z};
}
inline Floats3 inverse_rotate(const float* m, const Floats3& v) {
  return {m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
          m[2] * v.x + m[5] * v.y + m[8] * v.z};
}

}  // namespace trundle::TRUNDLE_ISA
