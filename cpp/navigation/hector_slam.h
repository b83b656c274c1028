// Mapping by scans alone: each is matched with a pyramid of grids, from coarse to fine, as in Kohlbrecher, von Stryk,
// Meyer and Klingauf, "A Flexible and Scalable SLAM System with Full 3D Motion Estimation" (2011).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "occupancy_level.h"
#include "planar_pose.h"

namespace trundle::navigation {

struct HectorOptions {
  double resolution = 0.025;            // size of the finest level's cells [m]
  int size = 1024;                      // width and height of the finest level [cells]
  double start_x = 0.5, start_y = 0.5;  // place of the world's origin, as a ratio of the size
  int levels = 3;
  double update_factor_free = 0.4, update_factor_occupied = 0.9;  // probabilities
  double update_distance = 0.4, update_angle = 0.9;  // [m], [rad]; least motion between scans that are entered
};

class HectorSlam {
 public:
  explicit HectorSlam(const HectorOptions& options);

  // Forgets the map, and puts the robot at the origin.
  void reset();

  // Matches a scan and enters it after enough motion; true if it was entered.
  //
  // start: first guess of the pose; sensor: origin of the beams in the robot's frame [m]; ends: ends of the beams
  // there [m]; is_known: `start` is the pose, and nothing is matched.
  bool update(const PlanarPose& start, const Point& sensor, const std::vector<Point>& ends, bool is_known);

  PlanarPose pose() const { return pose_; }
  // Covariance of the last match: xx, xy, yy, xt, yt, tt [m], [rad].
  std::array<double, 6> covariance() const { return covariance_; }
  // Mean probability of the cells at the ends of the last scan.
  double score() const { return score_; }
  // The finest level's cells: 100 occupied, 0 free, -1 unknown.
  std::vector<std::int8_t> cells() const;
  int size() const { return levels_[0].columns(); }

 private:
  PlanarPose match(const PlanarPose& start, const std::vector<Point>& ends);

  HectorOptions options_;
  std::vector<OccupancyLevel> levels_;  // finest first
  PlanarPose pose_, entered_;
  bool has_map_ = false;
  double score_ = 0.0;
  std::array<double, 6> covariance_{};
};

}  // namespace trundle::navigation
