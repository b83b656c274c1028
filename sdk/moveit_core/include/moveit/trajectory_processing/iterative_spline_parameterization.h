#pragma once

#include "moveit/trajectory_processing/iterative_time_parameterization.h"

namespace trajectory_processing {

/** Answered by the iterative parabolic law, which takes longer times and keeps the same limits. */
class IterativeSplineParameterization {
 public:
  bool computeTimeStamps(robot_trajectory::RobotTrajectory& trajectory, double max_velocity_scaling_factor = 1.0,
                         double max_acceleration_scaling_factor = 1.0) const {
    return IterativeParabolicTimeParameterization().computeTimeStamps(trajectory, max_velocity_scaling_factor,
                                                                      max_acceleration_scaling_factor);
  }
};

}  // namespace trajectory_processing
