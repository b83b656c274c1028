#include "voxel_rays.h"

#include <bit>
#include <cmath>
#include <limits>

namespace trundle {

namespace {

void clear_voxel(const VoxelColumns& voxels, int x, int y, int z) {
  std::uint32_t& column = voxels.columns[voxels.shape.index(x, y)];
  column &= ~((std::uint32_t{1} << z) | (std::uint32_t{1} << (z + kMaxVoxelLevels)));
  const std::uint32_t occupied = column >> kMaxVoxelLevels, unknown = (column ^ occupied) & 0xffffu;
  if (std::popcount(occupied) > voxels.mark_threshold) return;
  voxels.costs[voxels.shape.index(x, y)] =
      std::popcount(unknown) <= voxels.unknown_threshold ? kFreeSpace : kNoInformation;
}

}  // namespace

// Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing" (1987).
void clear_voxel_ray(const VoxelColumns& voxels, const std::array<double, 3>& from, const std::array<double, 3>& to) {
  std::array<int, 3> cell{}, last{}, step{};
  std::array<double, 3> next{}, per{};
  int left = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double distance = to[axis] - from[axis];
    cell[axis] = static_cast<int>(std::floor(from[axis]));
    last[axis] = static_cast<int>(std::floor(to[axis]));
    step[axis] = distance < 0 ? -1 : 1;
    per[axis] = distance == 0 ? std::numeric_limits<double>::infinity() : std::fabs(1 / distance);
    const double edge = distance < 0 ? from[axis] - cell[axis] : cell[axis] + 1 - from[axis];
    next[axis] = distance == 0 ? per[axis] : edge * per[axis];
    left += std::abs(last[axis] - cell[axis]);
  }
  for (; left >= 0; --left) {
    if (!voxels.shape.contains(cell[0], cell[1]) || cell[2] < 0 || cell[2] >= voxels.levels) return;
    clear_voxel(voxels, cell[0], cell[1], cell[2]);
    std::size_t axis = next[0] < next[1] ? 0 : 1;
    if (next[2] < next[axis]) axis = 2;
    cell[axis] += step[axis];
    next[axis] += per[axis];
  }
}

}  // namespace trundle
