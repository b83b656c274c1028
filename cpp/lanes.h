// As many numbers at a time as the instruction set holds. Every operation is exact per lane (IEEE), so that the
// width never shows in a picture. Included by kernel.cc alone, inside the namespace of one instruction set.
#pragma once

#include <cstdint>

namespace trundle::TRUNDLE_ISA {

#if defined(__AVX512F__)
constexpr int kLanes = 16;
#elif defined(__AVX2__)
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif

typedef float F __attribute__((vector_size(kLanes * 4)));
typedef int32_t I __attribute__((vector_size(kLanes * 4)));  // also masks: 0 or -1
typedef int64_t L __attribute__((vector_size(kLanes * 4)));

struct F3 {
  F x, y, z;
};

inline F splat(float value) { return F{} + value; }
inline I splat(int32_t value) { return I{} + value; }
inline F select(I mask, F yes, F no) { return (F)((mask & (I)yes) | (~mask & (I)no)); }
inline I select(I mask, I yes, I no) { return (mask & yes) | (~mask & no); }
inline F max(F a, F b) { return select(a > b, a, b); }
inline F min(F a, F b) { return select(a < b, a, b); }
inline F abs(F a) { return (F)((I)a & 0x7fffffff); }

inline F sqrt(F a) {
  F root;
  for (int i = 0; i < kLanes; ++i) root[i] = __builtin_sqrtf(a[i]);
  return root;
}

inline bool any(I mask) {
  const L wide = (L)mask;
  int64_t all = 0;
  for (int i = 0; i < kLanes / 2; ++i) all |= wide[i];
  return all != 0;
}

inline F counting() {
  F numbers;
  for (int i = 0; i < kLanes; ++i) numbers[i] = (float)i;
  return numbers;
}

inline I to_int(F a) { return __builtin_convertvector(a, I); }
inline F load(const float* at) {
  F value;
  __builtin_memcpy(&value, at, sizeof value);
  return value;
}
inline I load(const int32_t* at) {
  I value;
  __builtin_memcpy(&value, at, sizeof value);
  return value;
}
inline void store(float* at, F value) { __builtin_memcpy(at, &value, sizeof value); }
inline void store(int32_t* at, I value) { __builtin_memcpy(at, &value, sizeof value); }

inline F dot(const F3& a, const F3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline F3 operator+(const F3& a, const F3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline F3 operator*(const F3& a, F s) { return {a.x * s, a.y * s, a.z * s}; }

}  // namespace trundle::TRUNDLE_ISA
