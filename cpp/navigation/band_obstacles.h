// What bands keep away from: the outline of a costmap's obstacles, and those that a band may pass on either side.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "costmap_cells.h"

namespace trundle::navigation {

// Columns and rows of the lethal cells beside others.
[[nodiscard]] std::vector<std::array<double, 2>> obstacle_outline(const std::uint8_t* costs, const GridShape& shape);

// A cell of each group of inscribed and lethal cells that does not touch the grid's edge: the first in row-major order.
// Cells of a group touch at sides or corners.
[[nodiscard]] std::vector<std::array<double, 2>> obstacle_islands(const std::uint8_t* costs, const GridShape& shape);

}  // namespace trundle::navigation
