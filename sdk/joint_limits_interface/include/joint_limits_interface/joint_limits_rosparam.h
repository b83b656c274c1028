#pragma once

#include <ros/ros.h>

#include <string>

#include <joint_limits_interface/joint_limits.h>

namespace joint_limits_interface {

namespace internal {

/** Read `has_NAME` and, if it is true, the numbers `names`; a number that is missing leaves the limit off. */
template <class... Numbers>
void readLimit(const ros::NodeHandle& node, const std::string& has, bool& is_on, const Numbers&... numbers) {
  bool is_set = false;
  if (!node.getParam(has, is_set)) return;
  if (!is_set) {
    is_on = false;
    return;
  }
  bool is_complete = true;
  const bool found[] = {numbers(node)...};
  for (const bool one : found) is_complete = is_complete && one;
  is_on = is_on || is_complete;
}

struct Number {
  const char* name;
  double& value;
  bool operator()(const ros::NodeHandle& node) const {
    double read = 0.0;
    if (!node.getParam(name, read)) return false;
    value = read;
    return true;
  }
};

}  // namespace internal

/** Read `joint_limits/JOINT/has_position_limits`, `min_position` and so on; false if there are none. */
inline bool getJointLimits(const std::string& joint_name, const ros::NodeHandle& nh, JointLimits& limits) {
  using internal::Number;
  const std::string name = "joint_limits/" + joint_name;
  if (!nh.hasParam(name)) {
    ROS_DEBUG_STREAM("No joint limits specification found for joint '" << joint_name << "' in the parameter server "
                                                                       << "(namespace " << nh.getNamespace() << ").");
    return false;
  }
  const ros::NodeHandle node(nh, name);
  internal::readLimit(node, "has_position_limits", limits.has_position_limits,
                      Number{"min_position", limits.min_position}, Number{"max_position", limits.max_position});
  if (!limits.has_position_limits) node.getParam("angle_wraparound", limits.angle_wraparound);
  internal::readLimit(node, "has_velocity_limits", limits.has_velocity_limits,
                      Number{"max_velocity", limits.max_velocity});
  internal::readLimit(node, "has_acceleration_limits", limits.has_acceleration_limits,
                      Number{"max_acceleration", limits.max_acceleration});
  internal::readLimit(node, "has_jerk_limits", limits.has_jerk_limits, Number{"max_jerk", limits.max_jerk});
  internal::readLimit(node, "has_effort_limits", limits.has_effort_limits, Number{"max_effort", limits.max_effort});
  return true;
}

/** Read `joint_limits/JOINT/has_soft_limits`, `k_position`, `k_velocity`, `soft_lower_limit` and `soft_upper_limit`;
    false if one is missing. */
inline bool getSoftJointLimits(const std::string& joint_name, const ros::NodeHandle& nh, SoftJointLimits& soft_limits) {
  using internal::Number;
  const ros::NodeHandle node(nh, "joint_limits/" + joint_name);
  SoftJointLimits read;
  bool has_limits = false;
  internal::readLimit(node, "has_soft_limits", has_limits, Number{"k_position", read.k_position},
                      Number{"k_velocity", read.k_velocity}, Number{"soft_lower_limit", read.min_position},
                      Number{"soft_upper_limit", read.max_position});
  if (has_limits) soft_limits = read;
  return has_limits;
}

}  // namespace joint_limits_interface
