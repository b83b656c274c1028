// Per-pixel passes over finished images. Included by kernel.cc only.
#pragma once

#include "kernel.h"
#include "simd.h"

namespace trundle::TRUNDLE_ISA {

constexpr float kInfinity = __builtin_inff(), kNotANumber = __builtin_nanf("");

// 3 * kLanes bytes: red, green, blue per lane.
inline void store_colors(uint8_t* to, Ints colors) {
#if defined(__AVX512F__)
  const __m512i together = _mm512_shuffle_epi8(
      reinterpret_cast<__m512i>(colors),
      _mm512_broadcast_i32x4(_mm_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, -1, -1, -1, -1)));
  const __m512i order = _mm512_setr_epi32(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 0, 0, 0, 0);
  _mm512_mask_storeu_epi32(to, 0x0fff, _mm512_permutexvar_epi32(order, together));
#elif defined(__AVX2__)
  const __m256i together = _mm256_shuffle_epi8(
      reinterpret_cast<__m256i>(colors),
      _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, -1, -1, -1, -1)));
  const __m256i packed = _mm256_permutevar8x32_epi32(together, _mm256_setr_epi32(0, 1, 2, 4, 5, 6, 0, 0));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm256_castsi256_si128(packed));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to + 16), _mm256_extracti128_si256(packed, 1));
#else
  const auto a = static_cast<uint32_t>(colors[0]), b = static_cast<uint32_t>(colors[1]),
             c = static_cast<uint32_t>(colors[2]), d = static_cast<uint32_t>(colors[3]);
  const uint32_t packed[3] = {a | b << 24, b >> 8 | c << 16, c >> 16 | d << 8};
  for (int k = 0; k < 3; ++k) __builtin_memcpy(to + 4 * k, packed + k, 4);  // one copy would go through memory
#endif
}

// Padded buffer rows to packed image rows; `depth` may be null.
void resolve(const View& view, int32_t top, int32_t bottom, const Buffers& buffers, uint8_t* rgb, float* depth) {
  for (int row = top; row < bottom; ++row) {
    const int from = row * view.stride;
    const int64_t to = static_cast<int64_t>(row) * view.width;
    int column = 0;
    for (; column + kLanes <= view.width; column += kLanes) {
      store_colors(rgb + 3 * (to + column), load(buffers.color + from + column));
      if (!depth) continue;
      const Floats away = 1.0f / load(buffers.inverse_depth + from + column);
      store(depth + to + column, select(load(buffers.id + from + column) < 0, splat(kInfinity), away));
    }
    for (; column < view.width; ++column) {
      for (int i = 0; i < 3; ++i)
        rgb[3 * (to + column) + i] = static_cast<uint8_t>(buffers.color[from + column] >> (8 * i));
      if (depth)
        depth[to + column] = buffers.id[from + column] < 0 ? kInfinity : 1.0f / buffers.inverse_depth[from + column];
    }
  }
}

void clip_depths(int64_t count, float near, float far, const float* depths, float* clipped) {
  for (int64_t i = 0; i < count; ++i) {
    const float depth = depths[i];
    clipped[i] = depth >= near && depth <= far && __builtin_fabsf(depth) < kInfinity ? depth : kNotANumber;
  }
}

// Transpose of gather_four: four consecutive numbers per lane.
inline void store_four(float* to, Floats a, Floats b, Floats c, Floats d) {
#if defined(__AVX512F__)
  const __m512d ab[2] = {
      _mm512_castps_pd(_mm512_unpacklo_ps(reinterpret_cast<__m512>(a), reinterpret_cast<__m512>(b))),
      _mm512_castps_pd(_mm512_unpackhi_ps(reinterpret_cast<__m512>(a), reinterpret_cast<__m512>(b)))};
  const __m512d cd[2] = {
      _mm512_castps_pd(_mm512_unpacklo_ps(reinterpret_cast<__m512>(c), reinterpret_cast<__m512>(d))),
      _mm512_castps_pd(_mm512_unpackhi_ps(reinterpret_cast<__m512>(c), reinterpret_cast<__m512>(d)))};
  // Vector k holds point 4 i + k in its i-th 128 bits.
  const __m512 of[4] = {
      _mm512_castpd_ps(_mm512_unpacklo_pd(ab[0], cd[0])), _mm512_castpd_ps(_mm512_unpackhi_pd(ab[0], cd[0])),
      _mm512_castpd_ps(_mm512_unpacklo_pd(ab[1], cd[1])), _mm512_castpd_ps(_mm512_unpackhi_pd(ab[1], cd[1]))};
  const __m512 low[2] = {_mm512_shuffle_f32x4(of[0], of[1], 0x44), _mm512_shuffle_f32x4(of[2], of[3], 0x44)};
  const __m512 high[2] = {_mm512_shuffle_f32x4(of[0], of[1], 0xee), _mm512_shuffle_f32x4(of[2], of[3], 0xee)};
  _mm512_storeu_ps(to, _mm512_shuffle_f32x4(low[0], low[1], 0x88));
  _mm512_storeu_ps(to + 16, _mm512_shuffle_f32x4(low[0], low[1], 0xdd));
  _mm512_storeu_ps(to + 32, _mm512_shuffle_f32x4(high[0], high[1], 0x88));
  _mm512_storeu_ps(to + 48, _mm512_shuffle_f32x4(high[0], high[1], 0xdd));
#else
  for (int i = 0; i < kLanes; ++i) {
    to[4 * i] = a[i];
    to[4 * i + 1] = b[i];
    to[4 * i + 2] = c[i];
    to[4 * i + 3] = d[i];
  }
#endif
}

// kLanes colors as PCL packs them.
inline Ints load_packed(const uint8_t* rgb) {
#if defined(__AVX512F__)
  const __m512i bytes = _mm512_maskz_loadu_epi32(0x0fff, rgb);
  const __m512i four =
      _mm512_permutexvar_epi32(_mm512_setr_epi32(0, 1, 2, 0, 3, 4, 5, 0, 6, 7, 8, 0, 9, 10, 11, 0), bytes);
  return reinterpret_cast<Ints>(_mm512_shuffle_epi8(
      four, _mm512_broadcast_i32x4(_mm_setr_epi8(2, 1, 0, -1, 5, 4, 3, -1, 8, 7, 6, -1, 11, 10, 9, -1))));
#else
  Ints packed;
  for (int i = 0; i < kLanes; ++i) packed[i] = rgb[3 * i] << 16 | rgb[3 * i + 1] << 8 | rgb[3 * i + 2];
  return packed;
#endif
}

void fill_cloud(int64_t count, const float* depth, const uint8_t* rgb, const float* right, const float* down,
                float* points) {
  int64_t at = 0;
  for (; at + kLanes <= count; at += kLanes) {
    const Floats ahead = load(depth + at);
    store_four(points + 4 * at, load(right + at) * ahead, load(down + at) * ahead, ahead,
               reinterpret_cast<Floats>(load_packed(rgb + 3 * at)));
  }
  for (; at < count; ++at) {
    const int32_t color = rgb[3 * at] << 16 | rgb[3 * at + 1] << 8 | rgb[3 * at + 2];
    points[4 * at] = right[at] * depth[at];
    points[4 * at + 1] = down[at] * depth[at];
    points[4 * at + 2] = depth[at];
    __builtin_memcpy(points + 4 * at + 3, &color, sizeof color);
  }
}

}  // namespace trundle::TRUNDLE_ISA
