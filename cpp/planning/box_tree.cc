#include "box_tree.h"

#include <numeric>

namespace trundle::planning {

namespace {

constexpr int kLeaf = 4;

double middle(const Box& box, int axis) { return box.low[axis] + box.high[axis]; }

}  // namespace

void BoxTree::build(std::span<const Box> boxes) {
  boxes_.assign(boxes.begin(), boxes.end());
  items_.resize(boxes.size());
  std::iota(items_.begin(), items_.end(), 0);
  nodes_.clear();
  if (boxes.empty()) return;
  nodes_.reserve(boxes.size() + 1);
  nodes_.emplace_back();
  split(0, 0, static_cast<int>(boxes.size()));
}

// Halves at the median of the widest axis, so the depth is at most log2 of the number of items.
void BoxTree::split(int node, int first, int count) {
  Box around, middles;
  for (int i = first; i < first + count; ++i) {
    const Box& box = boxes_[static_cast<std::size_t>(items_[static_cast<std::size_t>(i)])];
    around.add(box);
    const Vec3 center = 0.5 * (box.low + box.high);
    middles.add({center, center});
  }
  nodes_[static_cast<std::size_t>(node)].box = around;
  if (count <= kLeaf) {
    nodes_[static_cast<std::size_t>(node)].first = first;
    nodes_[static_cast<std::size_t>(node)].count = count;
    return;
  }
  const Vec3 size = middles.high - middles.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int half = count / 2;
  std::nth_element(items_.begin() + first, items_.begin() + first + half, items_.begin() + first + count,
                   [&](int a, int b) {
                     const double at_a = middle(boxes_[static_cast<std::size_t>(a)], axis),
                                  at_b = middle(boxes_[static_cast<std::size_t>(b)], axis);
                     return at_a != at_b ? at_a < at_b : a < b;
                   });
  const int children = static_cast<int>(nodes_.size());
  nodes_[static_cast<std::size_t>(node)].first = children;
  nodes_.emplace_back();
  nodes_.emplace_back();
  split(children, first, half);
  split(children + 1, first + half, count - half);
}

}  // namespace trundle::planning
