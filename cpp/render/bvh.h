// Bounding volume hierarchy of a mesh; nodes hold kMaxLanes children.
#pragma once

#include <vector>

#include "kernel.h"

namespace trundle {

struct Bvh {
  std::vector<BvhNode> nodes;
  std::vector<BvhLeaf> leaves;
  BvhView view() const { return {nodes.data(), leaves.data()}; }
};

// The mesh must have faces.
Bvh make_bvh(const Triangles& mesh);

}  // namespace trundle
