// Codes of cubes: the bits of their indices in turn, the order in which octomap's streams have the children.
#pragma once

#include <cstdint>

#include "occupancy_tree.h"

namespace trundle::navigation {

constexpr int kBlockLevels = 3;
constexpr int kBlockDepth = kTreeDepth - kBlockLevels;

// x lowest.
inline std::uint64_t interleaved(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < kTreeDepth; ++bit)
    code |= std::uint64_t{(x >> bit & 1U) | (y >> bit & 1U) << 1 | (z >> bit & 1U) << 2} << 3 * bit;
  return code;
}

inline int gathered(std::uint64_t code, int axis) {
  int value = 0;
  for (int bit = 0; bit < kTreeDepth; ++bit) value |= static_cast<int>(code >> (3 * bit + axis) & 1U) << bit;
  return value;
}

inline TreeLeaf leaf_of(std::uint64_t code, int depth) {
  return {gathered(code, 0), gathered(code, 1), gathered(code, 2), depth};
}

}  // namespace trundle::navigation
