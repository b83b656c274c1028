#include "cell_counts.h"

#include <cmath>
#include <cstdlib>

namespace trundle::navigation {

namespace {

constexpr double kTiny = 1e-12;

}  // namespace

void CellCounts::add(const Beam& beam, double length, bool is_hit) {
  const double end_x = beam.x + length * beam.dx, end_y = beam.y + length * beam.dy;
  if (!counts_.reaches(beam.x) || !counts_.reaches(beam.y) || !counts_.reaches(end_x) || !counts_.reaches(end_y))
    return;
  int column = counts_.cell_of(beam.x), row = counts_.cell_of(beam.y);
  const int end_column = counts_.cell_of(end_x), end_row = counts_.cell_of(end_y);
  // The end first, so that the map grows but once.
  Counts& end = counts_.at(end_column, end_row);
  ++end.visits;
  end.hits += is_hit;
  seen_.include(column, row);
  seen_.include(end_column, end_row);
  const int step_x = beam.dx < 0.0 ? -1 : 1, step_y = beam.dy < 0.0 ? -1 : 1;
  const double per_x = 1.0 / std::max(std::abs(beam.dx), kTiny), per_y = 1.0 / std::max(std::abs(beam.dy), kTiny);
  const double start_x = beam.x / resolution_, start_y = beam.y / resolution_;
  double next_x = (step_x > 0 ? column + 1 - start_x : start_x - column) * per_x;
  double next_y = (step_y > 0 ? row + 1 - start_y : start_y - row) * per_y;
  for (int left = std::abs(end_column - column) + std::abs(end_row - row); left > 0; --left) {
    ++counts_.at(column, row).visits;
    if (next_x < next_y) {
      next_x += per_x;
      column += step_x;
    } else {
      next_y += per_y;
      row += step_y;
    }
  }
}

std::vector<std::int8_t> CellCounts::draw(const MapFrame& frame) const {
  std::vector<std::int8_t> cells;
  cells.reserve(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  for (int row = 0; row < frame.height; ++row)
    for (int column = 0; column < frame.width; ++column) {
      const Counts* counts = counts_.find(frame.first_column + column, frame.first_row + row);
      if (counts == nullptr || counts->visits == 0) cells.push_back(-1);
      else
        cells.push_back(counts->hits > frame.occupied_threshold * counts->visits ? std::int8_t{100} : std::int8_t{0});
    }
  return cells;
}

}  // namespace trundle::navigation
