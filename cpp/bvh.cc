#include "bvh.h"

#include <algorithm>
#include <array>
#include <limits>

namespace trundle {

namespace {

constexpr int kBins = 16;
constexpr int kDeepest = kMostWaiting / kWidest - 2;

struct Box {
  std::array<float, 3> low{3e38f, 3e38f, 3e38f}, high{-3e38f, -3e38f, -3e38f};

  void take(const Box& other) {
    for (int i = 0; i < 3; ++i)
      low[i] = std::min(low[i], other.low[i]), high[i] = std::max(high[i], other.high[i]);
  }
  double area() const {
    const double x = (double)high[0] - low[0], y = (double)high[1] - low[1], z = (double)high[2] - low[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
  }
  float middle(int axis) const { return 0.5f * (low[axis] + high[axis]); }
};

std::array<float, 3> corner_of(const Triangles& mesh, int32_t face, int corner) {
  const int32_t vertex = mesh.corners[corner][face];
  return {mesh.places[0][vertex], mesh.places[1][vertex], mesh.places[2][vertex]};
}

void add_face(const Triangles& mesh, int32_t face, BvhLeaf& leaf, int32_t at) {
  const auto a = corner_of(mesh, face, 0), b = corner_of(mesh, face, 1), c = corner_of(mesh, face, 2);
  for (int x = 0; x < 3; ++x) {
    const int y = (x + 1) % 3, z = (x + 2) % 3;
    leaf.corner[x][at] = a[x], leaf.edges[0][x][at] = b[x] - a[x], leaf.edges[1][x][at] = c[x] - a[x];
    leaf.normal[x][at] =
        (float)(((double)b[y] - a[y]) * ((double)c[z] - a[z]) - ((double)b[z] - a[z]) * ((double)c[y] - a[y]));
  }
}

// A box, and below it either triangles, `count` from `first` on, or two boxes: the next one and `first`.
struct Pair {
  Box box;
  int32_t first, count;
  int32_t leaves;
};

// Divides by two, by the surface area heuristic.
struct Builder {
  const Triangles& mesh;
  std::vector<Box> boxes;
  std::vector<int32_t> order;
  std::vector<Pair> nodes;

  explicit Builder(const Triangles& mesh) : mesh(mesh), boxes((size_t)mesh.face_count) {
    for (int32_t face = 0; face < mesh.face_count; ++face) {
      order.push_back(face);
      for (int corner = 0; corner < 3; ++corner) {
        const auto p = corner_of(mesh, face, corner);
        boxes[face].take({p, p});
      }
    }
    divide(0, mesh.face_count, 0);
  }

  // Where the surface area heuristic says; the number of triangles in the first part, 0 where none is better.
  int32_t split(int32_t first, int32_t count, const Box& middles, double whole) {
    double best = (double)count * whole;
    int best_axis = -1, best_bin = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float extent = middles.high[axis] - middles.low[axis];
      if (!(extent > 0.0f)) continue;
      std::array<Box, kBins> bins;
      std::array<int32_t, kBins> counts{};
      for (int32_t i = first; i < first + count; ++i) {
        const int bin = bin_of(boxes[order[i]].middle(axis), middles, axis);
        bins[bin].take(boxes[order[i]]);
        ++counts[bin];
      }
      std::array<double, kBins> above{};
      Box box;
      int32_t many = 0;
      for (int bin = kBins - 1; bin > 0; --bin) box.take(bins[bin]), many += counts[bin], above[bin] = many * box.area();
      box = Box(), many = 0;
      for (int bin = 0; bin + 1 < kBins; ++bin) {
        box.take(bins[bin]), many += counts[bin];
        const double cost = many * box.area() + above[bin + 1] + 0.5 * whole;
        if (many > 0 && many < count && cost < best) best = cost, best_axis = axis, best_bin = bin;
      }
    }
    if (best_axis < 0) return 0;
    const auto begin = order.begin() + first;
    return (int32_t)(std::stable_partition(begin, begin + count, [&](int32_t face) {
                       return bin_of(boxes[face].middle(best_axis), middles, best_axis) <= best_bin;
                     }) -
                     begin);
  }

  static int bin_of(float at, const Box& middles, int axis) {
    const float share = (at - middles.low[axis]) / (middles.high[axis] - middles.low[axis]);
    return std::clamp((int)(share * kBins), 0, kBins - 1);
  }

  void divide(int32_t first, int32_t count, int depth) {
    Box box, middles;
    for (int32_t i = first; i < first + count; ++i) {
      const Box& one = boxes[order[i]];
      const std::array<float, 3> middle{one.middle(0), one.middle(1), one.middle(2)};
      box.take(one);
      middles.take({middle, middle});
    }
    const size_t here = nodes.size();
    nodes.push_back({box, first, count, (count + kLeaf - 1) / kLeaf});
    if (count <= kLeaf) return;
    int32_t left = depth < kDeepest ? split(first, count, middles, box.area()) : 0;
    if (left == 0 && count <= 64) return;
    if (left == 0 && depth >= kDeepest) return;
    if (left == 0) left = count / 2;
    divide(first, left, depth + 1);
    nodes[here].first = (int32_t)nodes.size();
    nodes[here].count = 0;
    divide(first + left, count - left, depth + 1);
    nodes[here].leaves = nodes[here + 1].leaves + nodes[nodes[here].first].leaves;
  }
};

// Joins what was divided to nodes of kWidest boxes, full where most of them are: at the bottom.
struct Joiner {
  const Triangles& mesh;
  const std::vector<int32_t>& order;
  const std::vector<Pair>& pairs;
  float margin;  // [m] what single precision may lose
  std::vector<BvhNode> nodes;
  std::vector<BvhLeaf> leaves;

  void join(int32_t from) {
    int32_t most = 1;  // leaves below one box
    while (most * kWidest < pairs[from].leaves) most *= kWidest;
    std::vector<int32_t> below = {from};
    while (below.size() < (size_t)kWidest) {
      const auto fullest = std::max_element(below.begin(), below.end(), [&](int32_t a, int32_t b) {
        return (pairs[a].count > 0 ? 0 : pairs[a].leaves) < (pairs[b].count > 0 ? 0 : pairs[b].leaves);
      });
      const int32_t divided = *fullest;
      if (pairs[divided].count > 0 || (pairs[divided].leaves <= most && divided != from)) break;
      *fullest = divided + 1;
      below.push_back(pairs[divided].first);
    }
    const size_t here = nodes.size();
    nodes.emplace_back();
    for (int i = 0; i < kWidest; ++i) {
      const bool used = i < (int)below.size();
      for (int axis = 0; axis < 3; ++axis) {
        nodes[here].low[axis][i] = used ? pairs[below[i]].box.low[axis] - margin : 3e38f;
        nodes[here].high[axis][i] = used ? pairs[below[i]].box.high[axis] + margin : -3e38f;
      }
      nodes[here].first[i] = nodes[here].count[i] = 0;
    }
    for (size_t i = 0; i < below.size(); ++i) {
      const Pair& pair = pairs[below[i]];
      nodes[here].first[i] = (int32_t)(pair.count > 0 ? leaves.size() : nodes.size());
      if (pair.count == 0) {
        join(below[i]);
        continue;
      }
      nodes[here].count[i] = (pair.count + kLeaf - 1) / kLeaf;
      leaves.resize(leaves.size() + (size_t)nodes[here].count[i]);
      for (int32_t k = 0; k < pair.count; ++k)
        add_face(mesh, order[pair.first + k], leaves[(size_t)(nodes[here].first[i] + k / kLeaf)], k % kLeaf);
    }
  }
};

}  // namespace

Bvh make_bvh(const Triangles& mesh) {
  Builder builder(mesh);
  float largest = 0.0f;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, -builder.nodes[0].box.low[axis], builder.nodes[0].box.high[axis]});
  Joiner joiner{mesh, builder.order, builder.nodes, 4e-6f * largest, {}, {}};
  joiner.join(0);
  return {std::move(joiner.nodes), std::move(joiner.leaves)};
}

}  // namespace trundle
