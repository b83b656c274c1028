#include "moveit/planning_scene_monitor/current_state_monitor.h"

#include <algorithm>
#include <chrono>

#include "moveit/robot_state/conversions.h"

namespace planning_scene_monitor {
namespace {

std::chrono::duration<double> bounded(double seconds) {
  return std::chrono::duration<double>(std::clamp(seconds, 0.0, 1e6));
}

}  // namespace

CurrentStateMonitor::CurrentStateMonitor(const moveit::core::RobotModelConstPtr& robot_model)
    : state_(robot_model), is_known_(robot_model->getVariableCount(), false) {}

void CurrentStateMonitor::startStateMonitor(const std::string& joint_states_topic) {
  if (spinner_) return;
  ros::NodeHandle node;
  node.setCallbackQueue(&queue_);
  subscriber_ = node.subscribe(joint_states_topic, 25, &CurrentStateMonitor::receive, this);
  spinner_.reset(new ros::AsyncSpinner(1, &queue_));
  spinner_->start();
}

void CurrentStateMonitor::stopStateMonitor() {
  if (!spinner_) return;
  subscriber_.shutdown();
  spinner_->stop();
  spinner_.reset();
}

void CurrentStateMonitor::receive(const sensor_msgs::JointStateConstPtr& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!moveit::core::jointStateToRobotState(*message, state_)) return;
  const moveit::core::RobotModel& model = *state_.getRobotModel();
  for (std::size_t i = 0; i < message->name.size(); ++i) {
    if (!model.hasJointModel(message->name[i])) continue;
    const moveit::core::JointModel* joint = model.getJointModel(message->name[i]);
    if (joint->getVariableCount() != 1) continue;
    is_known_[joint->getFirstVariableIndex()] = true;
    if (i < message->velocity.size()) state_.setVariableVelocity(message->name[i], message->velocity[i]);
    if (i < message->effort.size()) state_.setVariableEffort(message->name[i], message->effort[i]);
  }
  time_ = message->header.stamp;
  changed_.notify_all();
}

bool CurrentStateMonitor::isComplete(const std::vector<const moveit::core::JointModel*>& joints) const {
  return std::all_of(joints.begin(), joints.end(), [this](const moveit::core::JointModel* joint) {
    return joint->getVariableCount() != 1 || joint->isPassive() || is_known_[joint->getFirstVariableIndex()];
  });
}

bool CurrentStateMonitor::haveCompleteState() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return isComplete(getRobotModel()->getActiveJointModels());
}

bool CurrentStateMonitor::haveCompleteState(std::vector<std::string>& missing_joints) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  missing_joints.clear();
  for (const moveit::core::JointModel* joint : getRobotModel()->getActiveJointModels())
    if (!isComplete({joint})) missing_joints.push_back(joint->getName());
  return missing_joints.empty();
}

moveit::core::RobotStatePtr CurrentStateMonitor::getCurrentState() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::make_shared<moveit::core::RobotState>(state_);
}

ros::Time CurrentStateMonitor::getCurrentStateTime() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return time_;
}

bool CurrentStateMonitor::waitForCurrentState(const ros::Time& t, double wait_time) const {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, bounded(wait_time),
                           [&] { return isComplete(getRobotModel()->getActiveJointModels()) && time_ >= t; });
}

bool CurrentStateMonitor::waitForCompleteState(const std::string& group, double wait_time) const {
  const moveit::core::JointModelGroup* model = getRobotModel()->getJointModelGroup(group);
  if (model == nullptr) return false;
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, bounded(wait_time), [&] { return isComplete(model->getActiveJointModels()); });
}

}  // namespace planning_scene_monitor
