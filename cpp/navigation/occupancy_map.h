// Known map: free, occupied and unknown cells, distances to the occupied ones, rays.
#pragma once

#include <cstdint>
#include <vector>

namespace trundle::navigation {

struct OccupancyMap {
  int width = 0, height = 0;
  double resolution = 0.05;               // [m]
  double origin_x = 0.0, origin_y = 0.0;  // lower left corner [m]
  std::vector<std::int8_t> cells;         // row by row from below: 0 free, 100 occupied, anything else unknown

  bool contains(int column, int row) const { return column >= 0 && row >= 0 && column < width && row < height; }
  std::int8_t at(int column, int row) const {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)];
  }
};

// Distance of each cell's center to the center of the nearest occupied cell [m], at most `limit`; exact, in linear
// time, by Felzenszwalb and Huttenlocher, "Distance Transforms of Sampled Functions" (2012).
std::vector<float> distances_to_occupied(const OccupancyMap& map, double limit);

// Length of a ray to the first cell that is not free [m], at most `limit`; the map's edge counts as such a cell.
double cast_ray(const OccupancyMap& map, double x, double y, double angle, double limit);

}  // namespace trundle::navigation
