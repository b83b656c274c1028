// Meshes of fewer triangles, for where nobody would see all of them.
#pragma once

#include <vector>

#include "geometry.h"

namespace trundle {

constexpr int32_t kHeavy = 20'000;  // faces, from which on it is worth the while
constexpr double kFinest = 256.0;   // cells along the longest side of the finest grid

struct Coarse {
  Mesh mesh;
  Triangles triangles;  // the mesh's
  double off;  // how far the vertex that was moved most is from where it was [m]
};

// The same mesh with its vertices gathered to those of ever wider grids: from the finest to the coarsest.
std::vector<Coarse> coarser(const Mesh& mesh);

}  // namespace trundle
