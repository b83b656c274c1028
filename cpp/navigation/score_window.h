// Part of a map in which a scan's ends are looked up: 1 at what was hit, less beside it.
#pragma once

#include <cstdint>
#include <vector>

#include "occupancy_level.h"

namespace trundle::navigation {

class ScoreWindow {
 public:
  // Square cells about a center, to a distance of `half_width`; hits are smeared by a standard deviation. All in [m].
  // The cells are larger where there would be too many.
  ScoreWindow(const Point& center, double half_width, double resolution, double smear);

  // Enters a hit at a place in the map [m].
  void add(const Point& hit);
  // Enters what is between two hits.
  void add_between(const Point& a, const Point& b);

  // Makes the coarser levels of what was entered.
  void finish();

  struct Sample {
    double value, by_x, by_y;  // 0 to 1, and its derivatives [1 / m]
  };
  // Between the centers of cells.
  Sample sample(const Point& place) const;

  // Number of the cell at a place along an axis.
  int column_of(double x) const;
  int row_of(double y) const;
  double resolution() const { return resolution_; }

  // Highest value, 0 to 255, in the cells of a level: those from column << 2 level to (column + 2) << 2 level, and
  // rows.
  int highest(int level, int column, int row) const {
    const Level& cells = levels_[static_cast<std::size_t>(level)];
    if (column < 0 || row < 0 || column >= cells.size || row >= cells.size) return 0;
    return cells.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(cells.size) +
                        static_cast<std::size_t>(column)];
  }

  static constexpr int kLevels = 3;

 private:
  struct Level {
    int size = 0;
    std::vector<std::uint8_t> values;
  };

  double resolution_, smear_;  // [m]
  Point corner_{0.0, 0.0};
  std::vector<Level> levels_;
  int reach_;                          // of the kernels [cells]
  std::vector<std::uint8_t> kernels_;  // of a hit in each part of a cell
  std::vector<std::uint16_t> drawn_;   // a bit for each part of each cell: a kernel was drawn there
};

}  // namespace trundle::navigation
