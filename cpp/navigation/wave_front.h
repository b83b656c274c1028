#pragma once

#include <array>
#include <vector>

#include "costmap_cells.h"

namespace trundle {

constexpr float kUnreached = 1e10F;

// Cost of the cheapest path from any seed to each cell: the eikonal equation |∇u| = cost, solved outward in buckets.
//
// A cell whose cost is not finite or not positive blocks the front. The front ends once `stop` is reached.
class WaveFront {
 public:
  // A stop outside the grid lets the front reach every cell.
  WaveFront(const float* costs, GridShape shape, const std::vector<std::array<int, 2>>& seeds, std::array<int, 2> stop);
  [[nodiscard]] std::vector<float> take() { return std::move(potential_); }

 private:
  void push(std::size_t cell);
  void relax(int x, int y);
  void spread(std::size_t cell);
  [[nodiscard]] float at(int x, int y) const {
    return shape_.contains(x, y) ? potential_[shape_.index(x, y)] : kUnreached;
  }

  const float* costs_;
  GridShape shape_;
  std::vector<float> potential_;
  std::vector<std::vector<std::size_t>> buckets_;
  float width_ = 1;        // width of a bucket
  std::size_t first_ = 0;  // number of the bucket that is being spread, without wrapping
  std::size_t queued_ = 0;
};

// Steepest descent of a potential, in steps of half a cell, from one cell center to another: points in cells, where the
// center of the first cell is 0, 0. Empty if there is no path.
std::vector<std::array<double, 2>> descend(const float* potential, GridShape shape, std::array<int, 2> from,
                                           std::array<int, 2> to);

}  // namespace trundle
