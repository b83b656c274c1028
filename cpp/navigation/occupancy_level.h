// Grid of occupancy odds that scans are matched with and entered into: a level of the pyramid in Kohlbrecher, von
// Stryk, Meyer and Klingauf, "A Flexible and Scalable SLAM System with Full 3D Motion Estimation" (2011).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planar_pose.h"

namespace trundle::navigation {

struct Point {
  double x, y;  // [m]
};

// Sums of a Gauss-Newton step over the ends of a scan's beams.
struct NormalEquations {
  std::array<double, 6> hessian{};  // xx, xy, yy, xt, yt, tt: of x, y [m] and the yaw [rad]
  std::array<double, 3> gradient{};
};

class OccupancyLevel {
 public:
  // Cells (columns x rows) of a size [m]; origin: the lower left corner [m].
  OccupancyLevel(int columns, int rows, double resolution, const Point& origin);

  void clear();

  // Adds a scan: `free` is added to cells that a beam crosses, `occupied` to cells with an end; each cell changes
  // once in a scan, and an end counts more than crossings.
  //
  // origin: origin of the beams [m]; ends: ends of the beams in the map [m]; free, occupied: logarithms of odds.
  void enter(const Point& origin, const std::vector<Point>& ends, double free, double occupied);

  // Normal equations of the distances between occupied cells and the ends, which are relative to the robot at a pose.
  NormalEquations normal_equations(const PlanarPose& pose, const std::vector<Point>& ends) const;

  // Mean probability of the cells at the ends, 0 to 1.
  double score(const PlanarPose& pose, const std::vector<Point>& ends) const;

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  const std::vector<float>& log_odds() const { return log_odds_; }

 private:
  struct Sample {
    double probability, by_x, by_y;  // probability and its derivatives [1 / m]
  };

  Sample sample(double x, double y) const;
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  bool contains(int column, int row) const { return column >= 0 && row >= 0 && column < columns_ && row < rows_; }
  void free_ray(int from_column, int from_row, int to_column, int to_row, float by);

  int columns_, rows_;
  double resolution_;  // [m]
  Point origin_;
  std::vector<float> log_odds_;
  std::vector<std::uint32_t> freed_, occupied_;  // number of the last scan that changed each cell
  std::uint32_t scan_ = 0;
};

}  // namespace trundle::navigation
