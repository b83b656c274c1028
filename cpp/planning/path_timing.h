// The fastest times along a path within limits of velocity and acceleration, and times of given waypoints.
#pragma once

#include <vector>

#include "blended_path.h"

namespace trundle::planning {

struct TimedStates {
  std::vector<double> times;  // [s]
  std::vector<State> positions, velocities, accelerations;
};

struct MotionLimits {
  State velocity, acceleration;  // of each variable, above 0
};

// Reachability analysis on a grid along the path (Pham and Pham 2018), at rest at both ends, sampled every `step_s`.
TimedStates time_optimal(const BlendedPath& path, const MotionLimits& limits, double step_s);

// The waypoints themselves, with parabolas between them: times are stretched where accelerations are too high.
TimedStates time_parabolic(const std::vector<State>& waypoints, const MotionLimits& limits);

}  // namespace trundle::planning
