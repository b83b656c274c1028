#pragma once

#include "moveit/robot_trajectory/robot_trajectory.h"

namespace trajectory_processing {

/** Times of a trajectory's states, stretched until no velocity or acceleration exceeds its limit; where a joint has no
 * limit, 1 rad/s and 1 rad/s² (or m) hold. */
class IterativeParabolicTimeParameterization {
 public:
  explicit IterativeParabolicTimeParameterization(unsigned int max_iterations = 100,
                                                  double max_time_change_per_it = .01)
      : max_iterations_(max_iterations), max_time_change_per_it_(max_time_change_per_it) {}
  /** Scaling factors are from 0 to 1; others mean 1. */
  bool computeTimeStamps(robot_trajectory::RobotTrajectory& trajectory, double max_velocity_scaling_factor = 1.0,
                         double max_acceleration_scaling_factor = 1.0) const;

 private:
  unsigned int max_iterations_;
  double max_time_change_per_it_;
};

}  // namespace trajectory_processing
