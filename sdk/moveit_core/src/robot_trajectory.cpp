#include "moveit/robot_trajectory/robot_trajectory.h"

#include <algorithm>
#include <cmath>

#include "moveit/robot_state/conversions.h"

namespace robot_trajectory {

using moveit::core::JointModel;
using moveit::core::RobotState;
using moveit::core::RobotStatePtr;

const std::string& RobotTrajectory::getGroupName() const {
  static const std::string kAll;
  return group_ == nullptr ? kAll : group_->getName();
}

double RobotTrajectory::getWayPointDurationFromStart(std::size_t i) const {
  double sum = 0.0;
  for (std::size_t j = 0; j <= i && j < durations_.size(); ++j) sum += durations_[j];
  return sum;
}

void RobotTrajectory::setWayPointDurationFromPrevious(std::size_t i, double value) {
  if (durations_.size() <= i) durations_.resize(i + 1, 0.0);
  durations_[i] = value;
}

RobotTrajectory& RobotTrajectory::addSuffixWayPoint(const RobotStatePtr& state, double dt) {
  waypoints_.push_back(state);
  durations_.push_back(dt);
  return *this;
}
RobotTrajectory& RobotTrajectory::addSuffixWayPoint(const RobotState& state, double dt) {
  return addSuffixWayPoint(std::make_shared<RobotState>(state), dt);
}
RobotTrajectory& RobotTrajectory::addPrefixWayPoint(const RobotState& state, double dt) {
  return insertWayPoint(0, state, dt);
}
RobotTrajectory& RobotTrajectory::insertWayPoint(std::size_t i, const RobotState& state, double dt) {
  const auto place = static_cast<std::ptrdiff_t>(std::min(i, waypoints_.size()));
  waypoints_.insert(waypoints_.begin() + place, std::make_shared<RobotState>(state));
  durations_.insert(durations_.begin() + place, dt);
  return *this;
}

RobotTrajectory& RobotTrajectory::append(const RobotTrajectory& source, double dt) {
  const std::size_t first = waypoints_.size();
  waypoints_.insert(waypoints_.end(), source.waypoints_.begin(), source.waypoints_.end());
  durations_.insert(durations_.end(), source.durations_.begin(), source.durations_.end());
  if (durations_.size() > first) durations_[first] += dt;
  return *this;
}

RobotTrajectory& RobotTrajectory::clear() {
  waypoints_.clear();
  durations_.clear();
  return *this;
}

RobotTrajectory& RobotTrajectory::reverse() {
  std::reverse(waypoints_.begin(), waypoints_.end());
  for (RobotStatePtr& waypoint : waypoints_) {
    if (!waypoint->hasVelocities()) continue;
    waypoint = std::make_shared<RobotState>(*waypoint);
    for (std::size_t i = 0; i < waypoint->getVariableCount(); ++i) waypoint->getVariableVelocities()[i] *= -1.0;
  }
  if (!durations_.empty()) {
    durations_.push_back(durations_.front());
    durations_.pop_front();
    std::reverse(durations_.begin(), durations_.end());
  }
  return *this;
}

RobotTrajectory& RobotTrajectory::unwind() {
  for (std::size_t i = 1; i < waypoints_.size(); ++i) {
    for (const JointModel* joint : waypoints_[i]->getRobotModel()->getActiveJointModels()) {
      if (!joint->isContinuous()) continue;
      const double before = waypoints_[i - 1]->getJointPositions(joint)[0];
      const double value = before + std::remainder(waypoints_[i]->getJointPositions(joint)[0] - before, 2.0 * M_PI);
      waypoints_[i]->setJointPositions(joint, &value);
    }
  }
  return *this;
}

void RobotTrajectory::getRobotTrajectoryMsg(moveit_msgs::RobotTrajectory& trajectory,
                                            const std::vector<std::string>& joint_filter) const {
  trajectory = moveit_msgs::RobotTrajectory();
  if (waypoints_.empty()) return;
  const std::vector<const JointModel*>& joints =
      group_ == nullptr ? model_->getActiveJointModels() : group_->getActiveJointModels();
  std::vector<const JointModel*> written;
  for (const JointModel* joint : joints) {
    const bool is_wanted = joint_filter.empty() ||
                           std::find(joint_filter.begin(), joint_filter.end(), joint->getName()) != joint_filter.end();
    if (is_wanted && joint->getVariableCount() == 1) written.push_back(joint);
  }
  trajectory.joint_trajectory.header.frame_id = model_->getModelFrame();
  for (const JointModel* joint : written) trajectory.joint_trajectory.joint_names.push_back(joint->getName());
  double time = 0.0;
  for (std::size_t i = 0; i < waypoints_.size(); ++i) {
    const RobotState& state = *waypoints_[i];
    time += durations_[i];
    trajectory_msgs::JointTrajectoryPoint point;
    for (const JointModel* joint : written) {
      const std::size_t variable = joint->getFirstVariableIndex();
      point.positions.push_back(state.getVariablePositions()[variable]);
      if (state.hasVelocities()) point.velocities.push_back(state.getVariableVelocities()[variable]);
      if (state.hasAccelerations()) point.accelerations.push_back(state.getVariableAccelerations()[variable]);
    }
    point.time_from_start = ros::Duration(time);
    trajectory.joint_trajectory.points.push_back(point);
  }
}

RobotTrajectory& RobotTrajectory::setRobotTrajectoryMsg(const RobotState& reference_state,
                                                        const moveit_msgs::RobotTrajectory& trajectory) {
  return setRobotTrajectoryMsg(reference_state, trajectory.joint_trajectory);
}

RobotTrajectory& RobotTrajectory::setRobotTrajectoryMsg(const RobotState& reference_state,
                                                        const trajectory_msgs::JointTrajectory& trajectory) {
  clear();
  double time = 0.0;
  for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
    const trajectory_msgs::JointTrajectoryPoint& point = trajectory.points[i];
    const auto state = std::make_shared<RobotState>(reference_state);
    moveit::core::jointTrajPointToRobotState(trajectory, i, *state);
    for (std::size_t j = 0; j < std::min(trajectory.joint_names.size(), point.velocities.size()); ++j)
      state->setVariableVelocity(trajectory.joint_names[j], point.velocities[j]);
    for (std::size_t j = 0; j < std::min(trajectory.joint_names.size(), point.accelerations.size()); ++j)
      state->getVariableAccelerations()[model_->getVariableIndex(trajectory.joint_names[j])] = point.accelerations[j];
    addSuffixWayPoint(state, point.time_from_start.toSec() - time);
    time = point.time_from_start.toSec();
  }
  return *this;
}

bool RobotTrajectory::getStateAtDurationFromStart(double request_duration, RobotStatePtr& output_state) const {
  if (waypoints_.empty()) return false;
  double time = durations_[0];
  std::size_t next = 0;
  while (time < request_duration && next + 1 < waypoints_.size()) time += durations_[++next];
  if (next == 0 || durations_[next] <= 0.0 || request_duration >= time) {
    *output_state = *waypoints_[next];
    return true;
  }
  waypoints_[next - 1]->interpolate(*waypoints_[next], 1.0 - (time - request_duration) / durations_[next],
                                    *output_state);
  return true;
}

}  // namespace robot_trajectory
