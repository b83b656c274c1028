// Map of a trajectory: how many beams crossed each cell, and how many ended in it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "patch_map.h"

namespace trundle::navigation {

// Bounds of a drawn map and when a cell counts as occupied.
struct MapFrame {
  int first_column, first_row;  // numbers of the cells; that of (0, 0) [m] is 0
  int width, height;            // [cells]
  double occupied_threshold;
};

// Cells that a trajectory saw, the last ones included; empty where the first exceed the last.
struct SeenCells {
  int first_column = std::numeric_limits<int>::max(), first_row = std::numeric_limits<int>::max();
  int last_column = std::numeric_limits<int>::min(), last_row = std::numeric_limits<int>::min();

  void include(int column, int row) {
    first_column = std::min(first_column, column);
    first_row = std::min(first_row, row);
    last_column = std::max(last_column, column);
    last_row = std::max(last_row, row);
  }
};

// Origin [m] and direction of unit length.
struct Beam {
  double x, y, dx, dy;
};

class CellCounts {
 public:
  explicit CellCounts(double resolution) : resolution_(resolution), counts_(resolution) {}

  // Adds a beam of a length [m]; is_hit: something is at its end.
  void add(const Beam& beam, double length, bool is_hit);

  const SeenCells& seen() const { return seen_; }
  // Cells row by row from below: -1 unknown, 0 free, 100 occupied.
  std::vector<std::int8_t> draw(const MapFrame& frame) const;

 private:
  struct Counts {
    std::int32_t hits = 0, visits = 0;
  };

  double resolution_;  // [m]
  SeenCells seen_;
  PatchMap<Counts> counts_;
};

}  // namespace trundle::navigation
