// Random numbers that are the same with every standard library: xoshiro256** (Blackman and Vigna, 2018).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace trundle::navigation {

class Random {
 public:
  explicit Random(std::uint64_t seed) {
    for (auto& word : state_) {  // splitmix64
      seed += 0x9e3779b97f4a7c15u;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      word = z ^ (z >> 31);
    }
  }

  // In [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  // Mean 0, the given standard deviation; Marsaglia's polar method.
  double gaussian(double sigma) {
    if (sigma <= 0.0) return 0.0;
    double x, square;
    do {
      x = 2.0 * uniform() - 1.0;
      const double y = 2.0 * uniform() - 1.0;
      square = x * x + y * y;
    } while (square >= 1.0 || square == 0.0);
    return sigma * x * std::sqrt(-2.0 * std::log(square) / square);
  }

 private:
  std::uint64_t next() {
    const auto rotated = [](std::uint64_t word, int bits) { return (word << bits) | (word >> (64 - bits)); };
    const std::uint64_t result = rotated(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotated(state_[3], 45);
    return result;
  }

  std::array<std::uint64_t, 4> state_;
};

}  // namespace trundle::navigation
