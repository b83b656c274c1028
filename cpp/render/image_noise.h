// Gaussian image noise. Counter-based: each number depends on the key and its index only, so that neither the vector
// width nor the number of threads changes it. Included by kernel.cc only.
#pragma once

#include "kernel.h"
#include "simd.h"

namespace trundle::TRUNDLE_ISA {

typedef uint32_t Uints __attribute__((vector_size(kLanes * 4)));

// Wellons' "lowbias32" integer hash.
inline Uints hash(Uints x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

// Taylor series on [-pi/4, pi/4], error 1e-6.
inline void sine_cosine(Floats a, Floats& sine, Floats& cosine) {
  const Floats z = a * a;
  sine = a + a * z * (-1.0f / 6 + z * (1.0f / 120 - z * (1.0f / 5040)));
  cosine = 1.0f + z * (-0.5f + z * (1.0f / 24 + z * (-1.0f / 720 + z * (1.0f / 40320))));
}

// Box-Muller transform of the counters from `first` on.
inline void normal_pair(const uint32_t key[2], uint32_t first, Floats& one, Floats& other) {
  const Uints index = reinterpret_cast<Uints>(lane_numbers()) + first;
  const Uints a = hash(index ^ key[0]), b = hash(hash(index + key[1]) ^ key[0]);
  const Floats chance = (to_float(reinterpret_cast<Ints>(a >> 8)) + 1.0f) * (1.0f / (1 << 24));  // (0, 1]
  const Floats length = sqrt(max(-2.0f * 0.69314718f * log2(chance), Floats{}));
  const Floats angle =
      to_float(reinterpret_cast<Ints>(b << 2) >> 8) * (0.78539816f / (1 << 23));  // [-pi/4, pi/4) within a quadrant
  const Ints quarter = reinterpret_cast<Ints>(b >> 30);
  Floats sine, cosine;
  sine_cosine(angle, sine, cosine);
  const Floats x = select((quarter & 1) != 0, sine, cosine), y = select((quarter & 1) != 0, cosine, sine);
  one = select(((quarter + 1) & 2) != 0, -x, x) * length;
  other = select((quarter & 2) != 0, -y, y) * length;
}

constexpr int kNoiseBlock = 2 * kMaxLanes;

// kNoiseBlock standard normal numbers.
inline void normal_block(const uint32_t key[2], uint32_t block, float* numbers) {
  for (int i = 0; i < kMaxLanes; i += kLanes) {
    Floats one, other;
    normal_pair(key, block * kMaxLanes + static_cast<uint32_t>(i), one, other);
    store(numbers + i, one);
    store(numbers + kMaxLanes + i, other);
  }
}

void add_depth_noise(const Noise& noise, int64_t count, float* depths) {
  alignas(64) float normal[kNoiseBlock];
  for (int64_t at = 0; at < count; at += kNoiseBlock) {
    normal_block(noise.key, static_cast<uint32_t>(at / kNoiseBlock), normal);
    const int64_t rest = count - at < kNoiseBlock ? count - at : kNoiseBlock;
    for (int64_t i = 0; i < rest; ++i) depths[at + i] += noise.mean + noise.stddev * normal[i];
  }
}

void add_color_noise(const Noise& noise, int64_t count, uint8_t* rgb) {
  alignas(64) float normal[kNoiseBlock];
  for (int64_t at = 0; at < count; at += kNoiseBlock) {
    normal_block(noise.key, static_cast<uint32_t>(at / kNoiseBlock), normal);
    const int64_t rest = count - at < kNoiseBlock ? count - at : kNoiseBlock;
    for (int64_t i = 0; i < 3 * rest; ++i) {
      const float value =
          static_cast<float>(rgb[3 * at + i]) + 255.0f * (noise.mean + noise.stddev * normal[i / 3]) + 0.5f;
      rgb[3 * at + i] = static_cast<uint8_t>(value > 0.0f ? (value < 255.0f ? value : 255.0f) : 0.0f);
    }
  }
}

}  // namespace trundle::TRUNDLE_ISA
