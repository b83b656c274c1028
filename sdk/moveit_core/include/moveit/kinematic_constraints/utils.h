#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/QuaternionStamped.h>
#include <moveit_msgs/Constraints.h>

#include <string>
#include <vector>

#include "moveit/robot_state/robot_state.h"

namespace kinematic_constraints {

/** The second's entries are appended to the first's, but those for the same joint are joined to the range in both. */
moveit_msgs::Constraints mergeConstraints(const moveit_msgs::Constraints& first,
                                          const moveit_msgs::Constraints& second);
bool isEmpty(const moveit_msgs::Constraints& constraints);
/** Each joint of the group within a tolerance [m or rad] of its position in a state. */
moveit_msgs::Constraints constructGoalConstraints(const moveit::core::RobotState& state,
                                                  const moveit::core::JointModelGroup* group, double tolerance_below,
                                                  double tolerance_above);
moveit_msgs::Constraints constructGoalConstraints(const moveit::core::RobotState& state,
                                                  const moveit::core::JointModelGroup* group, double tolerance = 1e-4);
/** A link in a sphere about a pose [m], turned by at most an angle about each axis [rad]. */
moveit_msgs::Constraints constructGoalConstraints(const std::string& link, const geometry_msgs::PoseStamped& pose,
                                                  double tolerance_pos = 1e-3, double tolerance_angle = 1e-2);
/** A link in a box about a pose [m], turned by at most an angle about each axis [rad]. */
moveit_msgs::Constraints constructGoalConstraints(const std::string& link, const geometry_msgs::PoseStamped& pose,
                                                  const std::vector<double>& tolerance_pos,
                                                  const std::vector<double>& tolerance_angle);
moveit_msgs::Constraints constructGoalConstraints(const std::string& link, const geometry_msgs::QuaternionStamped& quat,
                                                  double tolerance = 1e-2);
moveit_msgs::Constraints constructGoalConstraints(const std::string& link,
                                                  const geometry_msgs::PointStamped& goal_point,
                                                  double tolerance = 1e-3);

}  // namespace kinematic_constraints
