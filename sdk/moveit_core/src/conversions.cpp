#include "moveit/robot_state/conversions.h"

#include <ros/console.h>

#include <algorithm>
#include <ostream>

namespace moveit {
namespace core {
namespace {

/** Set the variables that are known; false if the numbers of names and values differ. */
bool setNamed(RobotState& state, const std::vector<std::string>& names, const std::vector<double>& positions) {
  if (names.size() != positions.size()) {
    ROS_ERROR_NAMED("robot_state", "Different number of names and positions in JointState message: %zu, %zu",
                    names.size(), positions.size());
    return false;
  }
  const std::vector<std::string>& variables = state.getVariableNames();
  std::map<std::string, double> known;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::find(variables.begin(), variables.end(), names[i]) != variables.end()) known[names[i]] = positions[i];
  state.setVariablePositions(known);
  return true;
}

/** Joints with several variables; those of a planar joint are x, y and the angle about z. */
void setMultiDof(RobotState& state, const sensor_msgs::MultiDOFJointState& joints) {
  for (std::size_t i = 0; i < std::min(joints.joint_names.size(), joints.transforms.size()); ++i) {
    if (!state.getRobotModel()->hasJointModel(joints.joint_names[i])) continue;
    const JointModel* joint = state.getJointModel(joints.joint_names[i]);
    const auto& t = joints.transforms[i].translation;
    const auto& q = joints.transforms[i].rotation;
    if (joint->getType() == JointModel::FLOATING) {
      state.setJointPositions(joint, std::vector<double>{t.x, t.y, t.z, q.x, q.y, q.z, q.w}.data());
    } else if (joint->getType() == JointModel::PLANAR) {
      const double yaw = std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
      state.setJointPositions(joint, std::vector<double>{t.x, t.y, yaw}.data());
    }
  }
}

}  // namespace

bool jointStateToRobotState(const sensor_msgs::JointState& joint_state, RobotState& state) {
  const bool is_set = setNamed(state, joint_state.name, joint_state.position);
  state.update();
  return is_set;
}

bool robotStateMsgToRobotState(const moveit_msgs::RobotState& robot_state, RobotState& state,
                               bool copy_attached_bodies) {
  const bool has_joints =
      !robot_state.joint_state.name.empty() || !robot_state.multi_dof_joint_state.joint_names.empty();
  if (!has_joints && !robot_state.is_diff) {
    ROS_ERROR_NAMED("robot_state", "Found empty JointState message");
    return false;
  }
  const bool is_set = setNamed(state, robot_state.joint_state.name, robot_state.joint_state.position);
  setMultiDof(state, robot_state.multi_dof_joint_state);
  if (copy_attached_bodies) {
    if (!robot_state.is_diff) state.clearAttachedBodies();
    for (const auto& body : robot_state.attached_collision_objects)
      if (body.object.operation == moveit_msgs::CollisionObject::REMOVE) state.clearAttachedBody(body.object.id);
      else state.attachBody(body);
  }
  state.update();
  return is_set;
}

void robotStateToJointStateMsg(const RobotState& state, sensor_msgs::JointState& joint_state) {
  joint_state = sensor_msgs::JointState();
  for (const JointModel* joint : state.getRobotModel()->getJointModels()) {
    if (joint->getVariableCount() != 1) continue;
    const std::string& variable = joint->getVariableNames()[0];
    joint_state.name.push_back(variable);
    joint_state.position.push_back(state.getVariablePosition(variable));
    if (state.hasVelocities()) joint_state.velocity.push_back(state.getVariableVelocity(variable));
    if (state.hasEffort()) joint_state.effort.push_back(state.getVariableEffort(variable));
  }
  joint_state.header.frame_id = state.getRobotModel()->getModelFrame();
}

void robotStateToRobotStateMsg(const RobotState& state, moveit_msgs::RobotState& robot_state,
                               bool copy_attached_bodies) {
  robot_state = moveit_msgs::RobotState();
  robotStateToJointStateMsg(state, robot_state.joint_state);
  robot_state.multi_dof_joint_state.header.frame_id = state.getRobotModel()->getModelFrame();
  for (const JointModel* joint : state.getRobotModel()->getJointModels()) {
    if (joint->getVariableCount() < 2) continue;
    const Eigen::Isometry3d pose = joint->computeTransform(state.getJointPositions(joint));
    const Eigen::Quaterniond q(pose.linear());
    geometry_msgs::Transform transform;
    transform.translation.x = pose.translation().x();
    transform.translation.y = pose.translation().y();
    transform.translation.z = pose.translation().z();
    transform.rotation.x = q.x();
    transform.rotation.y = q.y();
    transform.rotation.z = q.z();
    transform.rotation.w = q.w();
    robot_state.multi_dof_joint_state.joint_names.push_back(joint->getName());
    robot_state.multi_dof_joint_state.transforms.push_back(transform);
  }
  if (copy_attached_bodies) robot_state.attached_collision_objects = state.attachedBodies();
}

bool jointTrajPointToRobotState(const trajectory_msgs::JointTrajectory& trajectory, std::size_t point_id,
                                RobotState& state) {
  if (trajectory.points.empty() || point_id >= trajectory.points.size()) {
    ROS_ERROR_NAMED("robot_state", "Invalid point_id");
    return false;
  }
  return setNamed(state, trajectory.joint_names, trajectory.points[point_id].positions);
}

void robotStateToStream(const RobotState& state, std::ostream& out, bool include_header, const std::string& separator) {
  const std::vector<std::string>& names = state.getVariableNames();
  if (include_header)
    for (std::size_t i = 0; i < names.size(); ++i) out << names[i] << (i + 1 < names.size() ? separator : "\n");
  for (std::size_t i = 0; i < names.size(); ++i)
    out << state.getVariablePositions()[i] << (i + 1 < names.size() ? separator : "\n");
}

}  // namespace core
}  // namespace moveit
