#pragma once

#include <moveit_msgs/RobotTrajectory.h>

#include <deque>
#include <string>

#include "moveit/robot_state/robot_state.h"

namespace robot_trajectory {

MOVEIT_CLASS_FORWARD(RobotTrajectory)

/** States of a robot, each with the time since the one before [s]. */
class RobotTrajectory {
 public:
  explicit RobotTrajectory(const moveit::core::RobotModelConstPtr& robot_model) : model_(robot_model) {}
  /** An empty name means all joints. */
  RobotTrajectory(const moveit::core::RobotModelConstPtr& robot_model, const std::string& group)
      : model_(robot_model), group_(group.empty() ? nullptr : robot_model->getJointModelGroup(group)) {}
  RobotTrajectory(const moveit::core::RobotModelConstPtr& robot_model, const moveit::core::JointModelGroup* group)
      : model_(robot_model), group_(group) {}

  const moveit::core::RobotModelConstPtr& getRobotModel() const { return model_; }
  const moveit::core::JointModelGroup* getGroup() const { return group_; }
  const std::string& getGroupName() const;
  void setGroupName(const std::string& group) { group_ = model_->getJointModelGroup(group); }

  std::size_t getWayPointCount() const { return waypoints_.size(); }
  std::size_t size() const { return waypoints_.size(); }
  bool empty() const { return waypoints_.empty(); }
  const moveit::core::RobotState& getWayPoint(std::size_t i) const { return *waypoints_[i]; }
  const moveit::core::RobotState& getFirstWayPoint() const { return *waypoints_.front(); }
  const moveit::core::RobotState& getLastWayPoint() const { return *waypoints_.back(); }
  moveit::core::RobotStatePtr& getWayPointPtr(std::size_t i) { return waypoints_[i]; }
  moveit::core::RobotStatePtr& getFirstWayPointPtr() { return waypoints_.front(); }
  moveit::core::RobotStatePtr& getLastWayPointPtr() { return waypoints_.back(); }

  const std::deque<double>& getWayPointDurations() const { return durations_; }
  double getWayPointDurationFromPrevious(std::size_t i) const { return i < durations_.size() ? durations_[i] : 0.0; }
  double getWayPointDurationFromStart(std::size_t i) const;
  void setWayPointDurationFromPrevious(std::size_t i, double value);
  double getDuration() const { return getWayPointDurationFromStart(size()); }
  double getAverageSegmentDuration() const {
    return durations_.size() < 2 ? 0.0 : getDuration() / static_cast<double>(durations_.size() - 1);
  }

  RobotTrajectory& addSuffixWayPoint(const moveit::core::RobotState& state, double dt);
  RobotTrajectory& addSuffixWayPoint(const moveit::core::RobotStatePtr& state, double dt);
  RobotTrajectory& addPrefixWayPoint(const moveit::core::RobotState& state, double dt);
  RobotTrajectory& insertWayPoint(std::size_t i, const moveit::core::RobotState& state, double dt);
  /** Append another trajectory, its first state a time `dt` after this one's last. */
  RobotTrajectory& append(const RobotTrajectory& source, double dt);
  RobotTrajectory& clear();
  RobotTrajectory& reverse();
  /** Take multiples of a turn out of continuous joints between neighbouring states. */
  RobotTrajectory& unwind();

  void getRobotTrajectoryMsg(moveit_msgs::RobotTrajectory& trajectory,
                             const std::vector<std::string>& joint_filter = {}) const;
  RobotTrajectory& setRobotTrajectoryMsg(const moveit::core::RobotState& reference_state,
                                         const moveit_msgs::RobotTrajectory& trajectory);
  RobotTrajectory& setRobotTrajectoryMsg(const moveit::core::RobotState& reference_state,
                                         const trajectory_msgs::JointTrajectory& trajectory);
  /** State at a time since the start [s]; false if the trajectory is empty. */
  bool getStateAtDurationFromStart(double request_duration, moveit::core::RobotStatePtr& output_state) const;

 private:
  moveit::core::RobotModelConstPtr model_;
  const moveit::core::JointModelGroup* group_ = nullptr;
  std::deque<moveit::core::RobotStatePtr> waypoints_;
  std::deque<double> durations_;
};

}  // namespace robot_trajectory
