// Rays through the voxels of costmap_2d's voxel layer.
#pragma once

#include <array>

#include "costmap_cells.h"

namespace trundle {

constexpr int kMaxVoxelLevels = 16;

// Each column has 32 bits: the lower half marks levels that are unknown or occupied, the upper half occupied ones.
struct VoxelColumns {
  GridShape shape;
  int levels;
  std::uint32_t* columns;
  std::uint8_t* costs;    // freed, or made unknown, with the columns
  int unknown_threshold;  // most unknown levels of a free column
  int mark_threshold;     // most occupied levels of a column without an obstacle
};

// Frees the voxels from `from` as far as `to`, both in cells; the first one reaches from 0 to 1.
void clear_voxel_ray(const VoxelColumns& voxels, const std::array<double, 3>& from, const std::array<double, 3>& to);

}  // namespace trundle
