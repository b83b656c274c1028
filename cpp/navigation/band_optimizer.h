// Optimization of a timed band by Levenberg-Marquardt steps; the poses at both ends stay.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "robot_body.h"
#include "timed_band.h"

namespace trundle::navigation {

struct BandScene {
  const RobotBody& body;
  const std::vector<Point>& obstacles;   // [m]
  const std::vector<Point>& via_points;  // [m]
  std::array<double, 3> velocity;        // of the robot at the start: ahead, sideways [m/s], turning [rad/s]
};

// Changes the band; returns its cost, with the costs of obstacles scaled.
double optimize_band(TimedBand& band, const BandSettings& settings, const BandScene& scene, double obstacle_scale);

}  // namespace trundle::navigation
