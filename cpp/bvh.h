// A tree of boxes around the triangles of a mesh, as many at once as the widest machine compares.
#pragma once

#include <vector>

#include "kernel.h"

namespace trundle {

struct Bvh {
  std::vector<BvhNode> nodes;
  std::vector<BvhLeaf> leaves;
  BvhView view() const { return {nodes.data(), leaves.data()}; }
};

// Of what is never empty: a mesh with faces.
Bvh make_bvh(const Triangles& mesh);

}  // namespace trundle
