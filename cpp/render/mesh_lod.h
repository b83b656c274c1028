// Levels of detail of a mesh by vertex clustering.
#pragma once

#include <vector>

#include "geometry.h"

namespace trundle {

constexpr int32_t kMinLodFaces = 20'000;  // number of faces up to which a mesh has no levels
constexpr double kFinestGrid = 256.0;     // cells along the longest side of the finest grid

struct MeshLod {
  Mesh mesh;
  Triangles triangles;  // view of `mesh`
  double error;         // largest distance by which a vertex was moved [m]
};

// Vertices merged per cell of ever coarser grids, finest level first.
std::vector<MeshLod> make_lods(const Mesh& mesh);

}  // namespace trundle
