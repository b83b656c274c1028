// The tree of boxes: every triangle is in one leaf, and its box around it.
#include "render/bvh.h"

#include <algorithm>
#include <map>
#include <random>

#include <doctest/doctest.h>

#include "render/geometry.h"

using namespace trundle;

namespace {

Mesh random_mesh(int faces, float size) {
  std::mt19937 source(7);
  std::uniform_real_distribution<float> place(-10.0f, 10.0f), offset(-size, size);
  std::vector<float> vertices;
  std::vector<int32_t> corners;
  for (int face = 0; face < faces; ++face) {
    const float centre[3] = {place(source), place(source), place(source)};
    for (int corner = 0; corner < 3; ++corner) {
      corners.push_back(static_cast<int32_t>(vertices.size() / 3));
      for (const float coordinate : centre) vertices.push_back(coordinate + offset(source));
    }
  }
  return make_mesh(vertices, corners, {}, {});
}

using Corner = std::array<float, 3>;

struct Walk {
  const Bvh& bvh;
  std::map<Corner, int> seen;  // first corners of triangles
  bool encloses = true;

  void visit(int32_t index) {
    const BvhNode& node = bvh.nodes[index];
    for (int i = 0; i < kMaxLanes; ++i) {
      if (node.low[0][i] > node.high[0][i]) continue;
      if (node.count[i] == 0) visit(node.first[i]);
      for (int32_t leaf = node.first[i]; leaf < node.first[i] + node.count[i]; ++leaf) count(bvh.leaves[leaf], node, i);
    }
  }

  void count(const BvhLeaf& leaf, const BvhNode& node, int child) {
    for (int i = 0; i < kLeafSize; ++i) {
      if (leaf.normal[0][i] == 0 && leaf.normal[1][i] == 0 && leaf.normal[2][i] == 0) continue;  // unused
      ++seen[{leaf.corner[0][i], leaf.corner[1][i], leaf.corner[2][i]}];
      for (int axis = 0; axis < 3; ++axis) {
        const float a = leaf.corner[axis][i], b = a + leaf.edges[0][axis][i], c = a + leaf.edges[1][axis][i];
        encloses &= std::min({a, b, c}) >= node.low[axis][child] && std::max({a, b, c}) <= node.high[axis][child];
      }
    }
  }
};

}  // namespace

TEST_CASE("every triangle is in one leaf, within its box") {
  for (const int faces : {1, 8, 9, 130, 3000}) {
    const Mesh mesh = random_mesh(faces, 0.5f);
    const Bvh bvh = make_bvh(mesh.triangles());
    Walk walk{bvh, {}};
    walk.visit(0);
    CAPTURE(faces);
    CHECK(walk.seen.size() == static_cast<size_t>(mesh.face_count));
    CHECK(std::all_of(walk.seen.begin(), walk.seen.end(), [](const auto& entry) { return entry.second == 1; }));
    CHECK(walk.encloses);
  }
}

TEST_CASE("triangles that no plane separates are divided, too") {
  std::vector<int32_t> corners;
  for (int face = 0; face < 1000; ++face) corners.insert(corners.end(), {0, 1, 2});
  const Mesh mesh = make_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, corners, {}, {});
  const Bvh bvh = make_bvh(mesh.triangles());
  Walk walk{bvh, {}};
  walk.visit(0);
  CHECK(walk.seen.at({0, 0, 0}) == 1000);
}
