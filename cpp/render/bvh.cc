#include "bvh.h"

#include <algorithm>
#include <array>
#include <limits>

namespace trundle {

namespace {

constexpr int kBins = 16;
constexpr int kMaxDepth = kMaxStack / kMaxLanes - 2;

struct Aabb {
  std::array<float, 3> low{3e38f, 3e38f, 3e38f}, high{-3e38f, -3e38f, -3e38f};

  void extend(const Aabb& other) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
  double area() const {
    const double x = static_cast<double>(high[0]) - low[0], y = static_cast<double>(high[1]) - low[1],
                 z = static_cast<double>(high[2]) - low[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
  }
  float centre(int axis) const { return 0.5f * (low[axis] + high[axis]); }
};

std::array<float, 3> corner_of(const Triangles& mesh, int32_t face, int corner) {
  const int32_t vertex = mesh.corners[corner][face];
  return {mesh.positions[0][vertex], mesh.positions[1][vertex], mesh.positions[2][vertex]};
}

void add_face(const Triangles& mesh, int32_t face, BvhLeaf& leaf, int32_t at) {
  const auto a = corner_of(mesh, face, 0), b = corner_of(mesh, face, 1), c = corner_of(mesh, face, 2);
  for (int x = 0; x < 3; ++x) {
    const int y = (x + 1) % 3, z = (x + 2) % 3;
    leaf.corner[x][at] = a[x];
    leaf.edges[0][x][at] = b[x] - a[x];
    leaf.edges[1][x][at] = c[x] - a[x];
    leaf.normal[x][at] = static_cast<float>((static_cast<double>(b[y]) - a[y]) * (static_cast<double>(c[z]) - a[z]) -
                                            (static_cast<double>(b[z]) - a[z]) * (static_cast<double>(c[y]) - a[y]));
  }
}

// Leaf with `count` triangles of Builder::order from `first` on or, with count 0, a parent of the next node and
// `first`.
struct BinaryNode {
  Aabb box;
  int32_t first, count;
  int32_t leaves;
};

// Binary tree by the surface area heuristic.
struct BinaryBuilder {
  const Triangles& mesh;
  std::vector<Aabb> boxes;
  std::vector<int32_t> order;
  std::vector<BinaryNode> nodes;

  explicit BinaryBuilder(const Triangles& mesh) : mesh(mesh), boxes(static_cast<size_t>(mesh.face_count)) {
    for (int32_t face = 0; face < mesh.face_count; ++face) {
      order.push_back(face);
      for (int corner = 0; corner < 3; ++corner) {
        const auto p = corner_of(mesh, face, corner);
        boxes[face].extend({p, p});
      }
    }
    divide(0, mesh.face_count, 0);
  }

  // Partition by the cheapest of kBins planes per axis; returns the left side's size, 0 where a leaf is cheaper.
  int32_t split(int32_t first, int32_t count, const Aabb& centres, double whole) {
    double best = static_cast<double>(count) * whole;
    int best_axis = -1, best_bin = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float extent = centres.high[axis] - centres.low[axis];
      if (!(extent > 0.0f)) continue;
      std::array<Aabb, kBins> bins;
      std::array<int32_t, kBins> counts{};
      for (int32_t i = first; i < first + count; ++i) {
        const int bin = bin_of(boxes[order[i]].centre(axis), centres, axis);
        bins[bin].extend(boxes[order[i]]);
        ++counts[bin];
      }
      std::array<double, kBins> above{};
      Aabb box;
      int32_t seen = 0;
      for (int bin = kBins - 1; bin > 0; --bin) {
        box.extend(bins[bin]);
        seen += counts[bin];
        above[bin] = seen * box.area();
      }
      box = Aabb();
      seen = 0;
      for (int bin = 0; bin + 1 < kBins; ++bin) {
        box.extend(bins[bin]);
        seen += counts[bin];
        const double cost = seen * box.area() + above[bin + 1] + 0.5 * whole;
        if (seen > 0 && seen < count && cost < best) {
          best = cost;
          best_axis = axis;
          best_bin = bin;
        }
      }
    }
    if (best_axis < 0) return 0;
    const auto begin = order.begin() + first;
    return static_cast<int32_t>(
        std::stable_partition(
            begin, begin + count,
            [&](int32_t face) { return bin_of(boxes[face].centre(best_axis), centres, best_axis) <= best_bin; }) -
        begin);
  }

  static int bin_of(float at, const Aabb& centres, int axis) {
    const float share = (at - centres.low[axis]) / (centres.high[axis] - centres.low[axis]);
    return std::clamp(static_cast<int>(share * kBins), 0, kBins - 1);
  }

  void divide(int32_t first, int32_t count, int depth) {
    Aabb box, centres;
    for (int32_t i = first; i < first + count; ++i) {
      const Aabb& one = boxes[order[i]];
      const std::array<float, 3> centre{one.centre(0), one.centre(1), one.centre(2)};
      box.extend(one);
      centres.extend({centre, centre});
    }
    const size_t here = nodes.size();
    nodes.push_back({box, first, count, (count + kLeafSize - 1) / kLeafSize});
    if (count <= kLeafSize) return;
    int32_t left = depth < kMaxDepth ? split(first, count, centres, box.area()) : 0;
    if (left == 0 && count <= 64) return;
    if (left == 0 && depth >= kMaxDepth) return;
    if (left == 0) left = count / 2;
    divide(first, left, depth + 1);
    nodes[here].first = static_cast<int32_t>(nodes.size());
    nodes[here].count = 0;
    divide(first + left, count - left, depth + 1);
    nodes[here].leaves = nodes[here + 1].leaves + nodes[nodes[here].first].leaves;
  }
};

// Collapses the binary tree into nodes of kMaxLanes children, filled from the bottom up.
struct Collapser {
  const Triangles& mesh;
  const std::vector<int32_t>& order;
  const std::vector<BinaryNode>& binary;
  float margin;  // [m] rounding error of single precision
  std::vector<BvhNode> nodes;
  std::vector<BvhLeaf> leaves;

  void collapse(int32_t from) {
    int32_t max_leaves = 1;  // maximum number of leaves below a child
    while (max_leaves * kMaxLanes < binary[from].leaves) max_leaves *= kMaxLanes;
    std::vector<int32_t> children = {from};
    while (children.size() < static_cast<size_t>(kMaxLanes)) {
      const auto fullest = std::max_element(children.begin(), children.end(), [&](int32_t a, int32_t b) {
        return (binary[a].count > 0 ? 0 : binary[a].leaves) < (binary[b].count > 0 ? 0 : binary[b].leaves);
      });
      const int32_t divided = *fullest;
      if (binary[divided].count > 0 || (binary[divided].leaves <= max_leaves && divided != from)) break;
      *fullest = divided + 1;
      children.push_back(binary[divided].first);
    }
    const size_t here = nodes.size();
    nodes.emplace_back();
    for (int i = 0; i < kMaxLanes; ++i) {
      const bool used = i < static_cast<int>(children.size());
      for (int axis = 0; axis < 3; ++axis) {
        nodes[here].low[axis][i] = used ? binary[children[i]].box.low[axis] - margin : 3e38f;
        nodes[here].high[axis][i] = used ? binary[children[i]].box.high[axis] + margin : -3e38f;
      }
      nodes[here].first[i] = nodes[here].count[i] = 0;
    }
    for (size_t i = 0; i < children.size(); ++i) {
      const BinaryNode& node = binary[children[i]];
      nodes[here].first[i] = static_cast<int32_t>(node.count > 0 ? leaves.size() : nodes.size());
      if (node.count == 0) {
        collapse(children[i]);
        continue;
      }
      nodes[here].count[i] = (node.count + kLeafSize - 1) / kLeafSize;
      leaves.resize(leaves.size() + static_cast<size_t>(nodes[here].count[i]));
      for (int32_t k = 0; k < node.count; ++k)
        add_face(mesh, order[node.first + k], leaves[nodes[here].first[i] + k / kLeafSize], k % kLeafSize);
    }
  }
};

}  // namespace

Bvh make_bvh(const Triangles& mesh) {
  BinaryBuilder builder(mesh);
  float largest = 0.0f;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, -builder.nodes[0].box.low[axis], builder.nodes[0].box.high[axis]});
  Collapser collapser{mesh, builder.order, builder.nodes, 4e-6f * largest, {}, {}};
  collapser.collapse(0);
  return {std::move(collapser.nodes), std::move(collapser.leaves)};
}

}  // namespace trundle
