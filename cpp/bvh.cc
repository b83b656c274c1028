#include "bvh.h"

#include <algorithm>
#include <array>
#include <limits>

namespace trundle {

namespace {

constexpr int kBins = 16;
constexpr int32_t kLeaf = 2;      // triangles that are not worth a division
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

BvhFace face_of(const Triangles& mesh, int32_t face) {
  const auto a = corner_of(mesh, face, 0), b = corner_of(mesh, face, 1), c = corner_of(mesh, face, 2);
  BvhFace made;
  for (int i = 0; i < 6; ++i) {
    const int x = i % 3, y = (i + 1) % 3, z = (i + 2) % 3;
    made.corner[i] = a[x], made.edges[0][i] = b[x] - a[x], made.edges[1][i] = c[x] - a[x];
    made.normal[i] = (float)(((double)b[y] - a[y]) * ((double)c[z] - a[z]) - ((double)b[z] - a[z]) * ((double)c[y] - a[y]));
  }
  return made;
}

// A box, and below it either triangles, `count` from `first` on, or two boxes: the next one and `first`.
struct Pair {
  Box box;
  int32_t first, count;
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
    nodes.push_back({box, first, count});
    if (count <= kLeaf) return;
    int32_t left = depth < kDeepest ? split(first, count, middles, box.area()) : 0;
    if (left == 0 && count <= 64) return;
    if (left == 0 && depth >= kDeepest) return;
    if (left == 0) left = count / 2;
    divide(first, left, depth + 1);
    nodes[here].first = (int32_t)nodes.size();
    nodes[here].count = 0;
    divide(first + left, count - left, depth + 1);
  }
};

// Joins what was divided, the largest boxes last, to nodes of kWidest boxes.
struct Joiner {
  const std::vector<Pair>& pairs;
  float margin;  // [m] what single precision may lose
  std::vector<BvhNode> nodes;

  void join(int32_t from) {
    std::vector<int32_t> below = {from};
    while (below.size() < (size_t)kWidest) {
      const auto area = [&](int32_t i) { return pairs[i].count > 0 ? -1.0 : pairs[i].box.area(); };
      const auto largest = std::max_element(below.begin(), below.end(),
                                            [&](int32_t a, int32_t b) { return area(a) < area(b); });
      const int32_t divided = *largest;
      if (pairs[divided].count > 0) break;
      *largest = divided + 1;
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
      nodes[here].count[i] = used ? pairs[below[i]].count : 0;
      nodes[here].first[i] = used ? pairs[below[i]].first : 0;
    }
    for (size_t i = 0; i < below.size(); ++i) {
      if (pairs[below[i]].count > 0) continue;
      nodes[here].first[i] = (int32_t)nodes.size();
      join(below[i]);
    }
  }
};

}  // namespace

Bvh make_bvh(const Triangles& mesh) {
  Builder builder(mesh);
  Bvh bvh;
  float largest = 0.0f;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, -builder.nodes[0].box.low[axis], builder.nodes[0].box.high[axis]});
  Joiner joiner{builder.nodes, 4e-6f * largest, {}};
  joiner.join(0);
  for (const int32_t face : builder.order) bvh.faces.push_back(face_of(mesh, face));
  bvh.nodes = std::move(joiner.nodes);
  return bvh;
}

}  // namespace trundle
