// Edges of a triangle mesh: components, pairs of sides, folds. Side 3 f + i of face f goes from its corner i to the
// next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trundle {

struct MeshView {
  const double* points;  // (N, 3)
  std::size_t point_count;
  const std::int64_t* faces;  // (M, 3)
  std::size_t face_count;
};

// Smallest index of the points that are connected with each point; without coordinates.
std::vector<std::int64_t> component_labels(const MeshView& mesh);

// Two sides for each edge, by the edges' smaller and larger points; empty if an edge has another number of sides.
std::vector<std::int64_t> sides_by_edge(const MeshView& mesh);

// Twice the area of each face.
std::vector<double> double_areas(const MeshView& mesh);

// Bound of the height of any point above any face, by the folds between neighbours; infinite if there is none.
//
// A surface that surrounds the origin once is the graph of a function of the direction: 1 on the surface, linear in
// each face's cone, and convex if convex across every edge. Otherwise its excess at a point is at most the sum of the
// excesses of the edges on the way to it.
double fold_height(const MeshView& mesh, const std::vector<std::int64_t>& sides);

}  // namespace trundle
