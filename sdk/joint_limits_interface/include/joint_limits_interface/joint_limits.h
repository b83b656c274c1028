#pragma once

namespace joint_limits_interface {

/** Limits of a joint [rad or m, and their derivatives; N·m or N]; each counts if its `has_` is true. */
struct JointLimits {
  double min_position = 0.0, max_position = 0.0, max_velocity = 0.0, max_acceleration = 0.0, max_jerk = 0.0,
         max_effort = 0.0;
  bool has_position_limits = false, has_velocity_limits = false, has_acceleration_limits = false,
       has_jerk_limits = false, has_effort_limits = false, angle_wraparound = false;
};

/** Positions near which a joint is slowed down, by gains. */
struct SoftJointLimits {
  double min_position = 0.0, max_position = 0.0, k_position = 0.0, k_velocity = 0.0;
};

}  // namespace joint_limits_interface
