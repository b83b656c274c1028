// Frontiers of a costmap: unknown cells beside free ones that the robot can reach.
#pragma once

#include <cstdint>
#include <vector>

#include "costmap_cells.h"

namespace trundle {

struct FrontierCell {
  std::int32_t frontier, column, row;  // number of the frontier, in the order of their distances
};

// Frontiers that free cells connect with a cell, in the order of the path lengths to them; a frontier's cells touch
// at sides or corners. Without a free cell near the start there are none.
std::vector<FrontierCell> find_frontiers(const std::uint8_t* costs, const GridShape& shape, int column, int row);

}  // namespace trundle
