// Bubbles of free space along a path, which contract and keep away from obstacles: Quinlan and Khatib, "Elastic bands:
// connecting path planning and control", ICRA 1993.
#pragma once

#include <array>
#include <vector>

#include "robot_body.h"

namespace trundle::navigation {

// Parameters of eband_local_planner by their names without `eband_`, and the robot's radius.
struct BubbleSettings {
  double robot_radius = 0.0;
  double min_relative_overlap = 0.7, tiny_bubble_expansion = 0.01;
  double internal_force_gain = 1.0, external_force_gain = 2.0, significant_force_lower_bound = 0.15;
  int num_iterations_eband_optimization = 3, equilibrium_approx_max_recursion_depth = 4;
};

struct Bubble {
  Point center;   // [m]
  double radius;  // by which the robot's center may move in any direction [m]
};

// Bubbles along a path (at least two points) after some rounds of forces; its ends stay. Empty where the robot does not
// fit.
[[nodiscard]] std::vector<Bubble> relax_bubbles(const std::vector<Point>& path, const std::vector<Point>& obstacles,
                                                const BubbleSettings& settings);

}  // namespace trundle::navigation
