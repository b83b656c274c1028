// Tree of axis-aligned boxes over the pieces of a scene.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "rigid.h"

namespace trundle::planning {

struct Box {
  Vec3 low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};

  bool overlaps(const Box& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y && low.z <= b.high.z &&
           b.low.z <= high.z;
  }
  void add(const Box& b) {
    low = {std::min(low.x, b.low.x), std::min(low.y, b.low.y), std::min(low.z, b.low.z)};
    high = {std::max(high.x, b.high.x), std::max(high.y, b.high.y), std::max(high.z, b.high.z)};
  }
  Box grown(double by) const { return {{low.x - by, low.y - by, low.z - by}, {high.x + by, high.y + by, high.z + by}}; }
  // Distance of two boxes; 0 if they overlap.
  double distance(const Box& b) const {
    const double x = std::max({0.0, low.x - b.high.x, b.low.x - high.x});
    const double y = std::max({0.0, low.y - b.high.y, b.low.y - high.y});
    const double z = std::max({0.0, low.z - b.high.z, b.low.z - high.z});
    return std::sqrt(x * x + y * y + z * z);
  }
};

// Box around a rotated one of some center and half lengths.
inline Box box_around(const Rigid& pose, const Vec3& center, const Vec3& half) {
  const Vec3 c = pose * center;
  const auto& m = pose.r.m;
  const Vec3 h{std::abs(m[0]) * half.x + std::abs(m[1]) * half.y + std::abs(m[2]) * half.z,
               std::abs(m[3]) * half.x + std::abs(m[4]) * half.y + std::abs(m[5]) * half.z,
               std::abs(m[6]) * half.x + std::abs(m[7]) * half.y + std::abs(m[8]) * half.z};
  return {c - h, c + h};
}

class BoxTree {
 public:
  // Tree over boxes, which keep their numbers.
  void build(std::span<const Box> boxes);

  // Call visit(number) for each box that overlaps `box`, until it returns false; return false then.
  template <typename Visit>
  bool query(const Box& box, Visit visit) const {
    return query_if([&](const Box& node) { return node.overlaps(box); }, visit);
  }

  // The same for boxes of which `wanted` is true, as it is for every box around them.
  template <typename Wanted, typename Visit>
  bool query_if(Wanted wanted, Visit visit) const {
    if (nodes_.empty()) return true;
    std::array<int, 128> stack;
    int depth = 0;
    stack[0] = 0;
    while (depth >= 0) {
      const Node& node = nodes_[static_cast<std::size_t>(stack[static_cast<std::size_t>(depth--)])];
      if (!wanted(node.box)) continue;
      if (node.count > 0) {
        for (int i = node.first; i < node.first + node.count; ++i) {
          const int item = items_[static_cast<std::size_t>(i)];
          if (wanted(boxes_[static_cast<std::size_t>(item)]) && !visit(item)) return false;
        }
      } else {
        stack[static_cast<std::size_t>(++depth)] = node.first + 1;
        stack[static_cast<std::size_t>(++depth)] = node.first;
      }
    }
    return true;
  }

 private:
  struct Node {
    Box box;
    int first = 0;  // first item of a leaf, or first of two children
    int count = 0;  // items of a leaf; 0: two children
  };

  void split(int node, int first, int count);

  std::vector<Box> boxes_;
  std::vector<int> items_;
  std::vector<Node> nodes_;
};

}  // namespace trundle::planning
