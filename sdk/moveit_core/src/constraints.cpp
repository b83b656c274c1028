#include <ros/console.h>

#include <algorithm>

#include "moveit/kinematic_constraints/utils.h"
#include "moveit/utils/moveit_error_code.h"

namespace kinematic_constraints {
namespace {

moveit_msgs::PositionConstraint position(const std::string& link, const std_msgs::Header& header,
                                         const geometry_msgs::Point& center, int shape,
                                         const std::vector<double>& dimensions) {
  moveit_msgs::PositionConstraint result;
  result.header = header;
  result.link_name = link;
  result.constraint_region.primitives.resize(1);
  result.constraint_region.primitives[0].type = static_cast<uint8_t>(shape);
  result.constraint_region.primitives[0].dimensions.assign(dimensions.begin(), dimensions.end());
  result.constraint_region.primitive_poses.resize(1);
  result.constraint_region.primitive_poses[0].position = center;
  result.constraint_region.primitive_poses[0].orientation.w = 1.0;
  result.weight = 1.0;
  return result;
}

moveit_msgs::OrientationConstraint orientation(const std::string& link, const std_msgs::Header& header,
                                               const geometry_msgs::Quaternion& wanted,
                                               const std::vector<double>& tolerance) {
  moveit_msgs::OrientationConstraint result;
  result.header = header;
  result.link_name = link;
  result.orientation = wanted;
  result.absolute_x_axis_tolerance = tolerance[0];
  result.absolute_y_axis_tolerance = tolerance[1];
  result.absolute_z_axis_tolerance = tolerance[2];
  result.weight = 1.0;
  return result;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

bool isEmpty(const moveit_msgs::Constraints& constraints) {
  return constraints.position_constraints.empty() && constraints.orientation_constraints.empty() &&
         constraints.visibility_constraints.empty() && constraints.joint_constraints.empty();
}

moveit_msgs::Constraints mergeConstraints(const moveit_msgs::Constraints& first,
                                          const moveit_msgs::Constraints& second) {
  moveit_msgs::Constraints result = first;
  append(result.position_constraints, second.position_constraints);
  append(result.orientation_constraints, second.orientation_constraints);
  append(result.visibility_constraints, second.visibility_constraints);
  for (const moveit_msgs::JointConstraint& other : second.joint_constraints) {
    const auto same = std::find_if(result.joint_constraints.begin(), result.joint_constraints.end(),
                                   [&other](const auto& one) { return one.joint_name == other.joint_name; });
    if (same == result.joint_constraints.end()) {
      result.joint_constraints.push_back(other);
      continue;
    }
    const double low = std::max(same->position - same->tolerance_below, other.position - other.tolerance_below);
    const double high = std::min(same->position + same->tolerance_above, other.position + other.tolerance_above);
    if (low > high) {
      ROS_ERROR_NAMED("kinematic_constraints",
                      "Attempted to merge incompatible constraints for joint '%s'. Discarding constraint.",
                      other.joint_name.c_str());
      continue;
    }
    same->position = std::clamp(0.5 * (same->position + other.position), low, high);
    same->tolerance_below = same->position - low;
    same->tolerance_above = high - same->position;
  }
  return result;
}

moveit_msgs::Constraints constructGoalConstraints(const moveit::core::RobotState& state,
                                                  const moveit::core::JointModelGroup* group, double tolerance_below,
                                                  double tolerance_above) {
  moveit_msgs::Constraints result;
  for (const moveit::core::JointModel* joint : group->getActiveJointModels()) {
    for (const std::string& variable : joint->getVariableNames()) {
      moveit_msgs::JointConstraint constraint;
      constraint.joint_name = variable;
      constraint.position = state.getVariablePosition(variable);
      constraint.tolerance_below = tolerance_below;
      constraint.tolerance_above = tolerance_above;
      constraint.weight = 1.0;
      result.joint_constraints.push_back(constraint);
    }
  }
  return result;
}

moveit_msgs::Constraints constructGoalConstraints(const moveit::core::RobotState& state,
                                                  const moveit::core::JointModelGroup* group, double tolerance) {
  return constructGoalConstraints(state, group, tolerance, tolerance);
}

moveit_msgs::Constraints constructGoalConstraints(const std::string& link, const geometry_msgs::PoseStamped& pose,
                                                  double tolerance_pos, double tolerance_angle) {
  moveit_msgs::Constraints result;
  result.position_constraints.push_back(
      position(link, pose.header, pose.pose.position, shape_msgs::SolidPrimitive::SPHERE, {tolerance_pos}));
  result.orientation_constraints.push_back(
      orientation(link, pose.header, pose.pose.orientation, std::vector<double>(3, tolerance_angle)));
  return result;
}

moveit_msgs::Constraints constructGoalConstraints(const std::string& link, const geometry_msgs::PoseStamped& pose,
                                                  const std::vector<double>& tolerance_pos,
                                                  const std::vector<double>& tolerance_angle) {
  moveit_msgs::Constraints result = constructGoalConstraints(link, pose);
  if (tolerance_pos.size() == 3) {
    result.position_constraints = {
        position(link, pose.header, pose.pose.position, shape_msgs::SolidPrimitive::BOX, tolerance_pos)};
  }
  if (tolerance_angle.size() == 3)
    result.orientation_constraints = {orientation(link, pose.header, pose.pose.orientation, tolerance_angle)};
  return result;
}

moveit_msgs::Constraints constructGoalConstraints(const std::string& link, const geometry_msgs::QuaternionStamped& quat,
                                                  double tolerance) {
  moveit_msgs::Constraints result;
  result.orientation_constraints.push_back(
      orientation(link, quat.header, quat.quaternion, std::vector<double>(3, tolerance)));
  return result;
}

moveit_msgs::Constraints constructGoalConstraints(const std::string& link,
                                                  const geometry_msgs::PointStamped& goal_point, double tolerance) {
  moveit_msgs::Constraints result;
  result.position_constraints.push_back(
      position(link, goal_point.header, goal_point.point, shape_msgs::SolidPrimitive::SPHERE, {tolerance}));
  return result;
}

}  // namespace kinematic_constraints

namespace moveit {
namespace core {

std::string error_code_to_string(const MoveItErrorCode& error_code) {
  using Codes = moveit_msgs::MoveItErrorCodes;
  static const std::map<int, std::string> kNames = {
      {Codes::SUCCESS, "SUCCESS"},
      {Codes::FAILURE, "FAILURE"},
      {Codes::PLANNING_FAILED, "PLANNING_FAILED"},
      {Codes::INVALID_MOTION_PLAN, "INVALID_MOTION_PLAN"},
      {Codes::MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE, "MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE"},
      {Codes::CONTROL_FAILED, "CONTROL_FAILED"},
      {Codes::UNABLE_TO_AQUIRE_SENSOR_DATA, "UNABLE_TO_AQUIRE_SENSOR_DATA"},
      {Codes::TIMED_OUT, "TIMED_OUT"},
      {Codes::PREEMPTED, "PREEMPTED"},
      {Codes::START_STATE_IN_COLLISION, "START_STATE_IN_COLLISION"},
      {Codes::START_STATE_VIOLATES_PATH_CONSTRAINTS, "START_STATE_VIOLATES_PATH_CONSTRAINTS"},
      {Codes::GOAL_IN_COLLISION, "GOAL_IN_COLLISION"},
      {Codes::GOAL_VIOLATES_PATH_CONSTRAINTS, "GOAL_VIOLATES_PATH_CONSTRAINTS"},
      {Codes::GOAL_CONSTRAINTS_VIOLATED, "GOAL_CONSTRAINTS_VIOLATED"},
      {Codes::INVALID_GROUP_NAME, "INVALID_GROUP_NAME"},
      {Codes::INVALID_GOAL_CONSTRAINTS, "INVALID_GOAL_CONSTRAINTS"},
      {Codes::INVALID_ROBOT_STATE, "INVALID_ROBOT_STATE"},
      {Codes::INVALID_LINK_NAME, "INVALID_LINK_NAME"},
      {Codes::INVALID_OBJECT_NAME, "INVALID_OBJECT_NAME"},
      {Codes::FRAME_TRANSFORM_FAILURE, "FRAME_TRANSFORM_FAILURE"},
      {Codes::COLLISION_CHECKING_UNAVAILABLE, "COLLISION_CHECKING_UNAVAILABLE"},
      {Codes::ROBOT_STATE_STALE, "ROBOT_STATE_STALE"},
      {Codes::SENSOR_INFO_STALE, "SENSOR_INFO_STALE"},
      {Codes::COMMUNICATION_FAILURE, "COMMUNICATION_FAILURE"},
      {Codes::START_STATE_INVALID, "START_STATE_INVALID"},
      {Codes::GOAL_STATE_INVALID, "GOAL_STATE_INVALID"},
      {Codes::UNRECOGNIZED_GOAL_TYPE, "UNRECOGNIZED_GOAL_TYPE"},
      {Codes::CRASH, "CRASH"},
      {Codes::ABORT, "ABORT"},
      {Codes::NO_IK_SOLUTION, "NO_IK_SOLUTION"},
  };
  const auto found = kNames.find(error_code.val);
  return found == kNames.end() ? "error " + std::to_string(error_code.val) : found->second;
}

}  // namespace core
}  // namespace moveit
