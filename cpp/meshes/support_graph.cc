#include "support_graph.h"

namespace trundle {

SupportGraph::SupportGraph(const MeshView& mesh) : points_(mesh.point_count), firsts_(mesh.point_count + 1, 0) {
  for (std::size_t i = 0; i < points_.size(); ++i) points_[i] = vector_at(mesh.points + 3 * i);
  for (std::size_t i = 0; i < 3 * mesh.face_count; ++i) firsts_[mesh.faces[i] + 1] += 2;
  for (std::size_t i = 1; i < firsts_.size(); ++i) firsts_[i] += firsts_[i - 1];
  neighbours_.resize(firsts_.back());
  std::vector<std::size_t> ends(firsts_.begin(), firsts_.end() - 1);
  for (std::size_t face = 0; face < mesh.face_count; ++face) {
    const std::int64_t* corners = mesh.faces + 3 * face;
    for (int i = 0; i < 3; ++i) {
      neighbours_[ends[corners[i]]++] = corners[(i + 1) % 3];  // both directions, as faces may be flipped
      neighbours_[ends[corners[i]]++] = corners[(i + 2) % 3];
    }
  }
}

std::int64_t SupportGraph::climb(const Vector3& direction, std::int64_t start) const {
  double highest = dot(points_[start], direction);
  for (;;) {
    std::int64_t top = start;
    for (std::size_t i = firsts_[start]; i < firsts_[start + 1]; ++i) {
      const double height = dot(points_[neighbours_[i]], direction);
      if (height > highest) {
        highest = height;
        top = neighbours_[i];
      }
    }
    if (top == start) return top;
    start = top;
  }
}

}  // namespace trundle
