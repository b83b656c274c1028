// Pose of a scan in a window of a map: the best of a grid of poses, found by branch and bound over coarser levels of
// the window as in Olson, "Real-Time Correlative Scan Matching" (2009), and refined by Gauss-Newton steps.
#pragma once

#include <array>

#include "planar_pose.h"
#include "range_scan.h"
#include "score_window.h"

namespace trundle::navigation {

struct SearchOptions {
  double half_width = 0.15;                                // along each axis [m]
  double half_angle = 0.35;                                // [rad]
  double angle_step = 0.035;                               // [rad]
  double fine_angle_step = 0.0035;                         // of the search about the best pose [rad]
  bool is_penalized = true;                                // poses away from the start count less
  double distance_variance = 0.09, angle_variance = 0.12;  // [m²], [rad²]
  double least_distance_factor = 0.5, least_angle_factor = 0.9;
};

struct ScanMatch {
  PlanarPose pose;                      // of the robot in the map
  double response = 0.0;                // mean value at the hits, 0 to 1
  std::array<double, 6> information{};  // xx, xy, yy, xt, yt, tt of the pose: what the surfaces hit tell
};

// Best pose of the grid about a start.
ScanMatch search(const ScoreWindow& window, const RangeScan& scan, const PlanarPose& start,
                 const SearchOptions& options);

// Climbs to the highest response near a pose.
ScanMatch refine(const ScoreWindow& window, const RangeScan& scan, const PlanarPose& start);

}  // namespace trundle::navigation
