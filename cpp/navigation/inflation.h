#pragma once

#include <vector>

#include "costmap_cells.h"

namespace trundle {

struct Window {
  int x0, y0, x1, y1;  // x1 and y1 are past the end
};

// Raises the costs in a window by the distance to the nearest lethal cell.
//
// Distances are exact and Euclidean, by rows, then columns; obstacles outside the window count, too. `costs` holds the
// cost for each squared distance in cells, up to the squared radius.
void inflate(std::uint8_t* cells, GridShape shape, Window window, const std::vector<std::uint8_t>& costs,
             bool inflate_unknown);

}  // namespace trundle
