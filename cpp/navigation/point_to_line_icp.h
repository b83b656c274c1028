// Motion between two scans by iterated closest points and lines: as in Censi, "An ICP variant using a point-to-line
// metric" (2008).
#pragma once

#include <array>
#include <vector>

#include "planar_pose.h"

namespace trundle::navigation {

// End of a beam [m]; a scan's points are in the order of its beams.
struct ScanPoint {
  double x, y;
};

struct IcpOptions {
  int max_iterations = 10;
  double epsilon_xy = 1e-6, epsilon_theta = 1e-6;        // a smaller step ends the search [m], [rad]
  double max_correspondence = 0.3;                       // limit from a point to the nearest one of the reference [m]
  double max_linear = 0.5, max_angular = 0.785;          // limits of the correction to the guess [m], [rad]
  double max_ratio = 0.9;                                // share of the correspondences that are used
  double adaptive_order = 0.7, adaptive_multiple = 2.0;  // errors above this multiple of the quantile are not used
  double sigma = 0.01;                                   // noise of a range, for the covariance [m]
  bool uses_lines = true;                                // false: distances between points
};

struct IcpMatch {
  bool is_valid = false;
  PlanarPose pose;                     // reference_from_scan
  double error = 0.0;                  // root of the mean square distance [m]
  int count = 0;                       // number of correspondences used
  std::array<double, 6> covariance{};  // xx, xy, yy, xt, yt, tt [m], [rad]
};

IcpMatch match_scans(const std::vector<ScanPoint>& reference, const std::vector<ScanPoint>& scan,
                     const PlanarPose& guess, const IcpOptions& options);

}  // namespace trundle::navigation
