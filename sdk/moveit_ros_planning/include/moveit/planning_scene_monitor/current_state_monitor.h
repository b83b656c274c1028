#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "moveit/macros/class_forward.h"
#include "moveit/robot_state/robot_state.h"

namespace planning_scene_monitor {

MOVEIT_CLASS_FORWARD(CurrentStateMonitor)

/** State of a robot from a topic of joint states, which is read in a thread of its own. */
class CurrentStateMonitor {
 public:
  explicit CurrentStateMonitor(const moveit::core::RobotModelConstPtr& robot_model);
  ~CurrentStateMonitor() { stopStateMonitor(); }

  void startStateMonitor(const std::string& joint_states_topic = "joint_states");
  void stopStateMonitor();
  bool isActive() const { return spinner_ != nullptr; }
  const moveit::core::RobotModelConstPtr& getRobotModel() const { return state_.getRobotModel(); }
  /** Whether each joint that moves has been told. */
  bool haveCompleteState() const;
  bool haveCompleteState(std::vector<std::string>& missing_joints) const;
  moveit::core::RobotStatePtr getCurrentState() const;
  ros::Time getCurrentStateTime() const;
  /** Wait, in wall time, until each joint has been told of at a time or later. */
  bool waitForCurrentState(const ros::Time& t = ros::Time(), double wait_time = 1.0) const;
  bool waitForCompleteState(double wait_time) const { return waitForCurrentState(ros::Time(), wait_time); }
  bool waitForCompleteState(const std::string& group, double wait_time) const;

 private:
  void receive(const sensor_msgs::JointStateConstPtr& message);
  bool isComplete(const std::vector<const moveit::core::JointModel*>& joints) const;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  moveit::core::RobotState state_;
  std::vector<bool> is_known_;
  ros::Time time_;
  ros::CallbackQueue queue_;
  ros::Subscriber subscriber_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
};

}  // namespace planning_scene_monitor
