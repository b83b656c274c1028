// Neighbours of the points of a convex mesh: a climb over them finds the highest point along a direction.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh_edges.h"
#include "vector3.h"

namespace trundle {

class SupportGraph {
 public:
  explicit SupportGraph(const MeshView& mesh);

  std::size_t size() const { return points_.size(); }

  // Index of the point at which a climb from `start` along a direction ends.
  std::int64_t climb(const Vector3& direction, std::int64_t start) const;

 private:
  std::vector<Vector3> points_;
  std::vector<std::size_t> firsts_;  // start of each point's neighbours in neighbours_, and the end
  std::vector<std::int64_t> neighbours_;
};

}  // namespace trundle
