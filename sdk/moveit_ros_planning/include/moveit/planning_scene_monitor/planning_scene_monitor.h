#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "moveit/planning_scene/planning_scene.h"
#include "moveit/planning_scene_monitor/current_state_monitor.h"
#include "moveit/robot_model_loader/robot_model_loader.h"

namespace planning_scene_monitor {

MOVEIT_CLASS_FORWARD(PlanningSceneMonitor)

/** Planning scene whose state follows a topic of joint states; its objects are those of the move_group that runs. */
class PlanningSceneMonitor {
 public:
  static const std::string DEFAULT_JOINT_STATES_TOPIC, DEFAULT_PLANNING_SCENE_TOPIC;

  explicit PlanningSceneMonitor(const std::string& robot_description, const std::string& name = "")
      : PlanningSceneMonitor(std::make_shared<robot_model_loader::RobotModelLoader>(robot_description), name) {}
  /** Raises moveit::Exception if the robot could not be loaded. */
  explicit PlanningSceneMonitor(const robot_model_loader::RobotModelLoaderPtr& loader, const std::string& name = "");

  const std::string& getName() const { return name_; }
  const robot_model_loader::RobotModelLoaderPtr& getRobotModelLoader() const { return loader_; }
  moveit::core::RobotModelConstPtr getRobotModel() const { return loader_->getModel(); }
  const planning_scene::PlanningScenePtr& getPlanningScene() { return scene_; }
  const CurrentStateMonitorPtr& getStateMonitor() const { return state_monitor_; }

  void startStateMonitor(const std::string& joint_states_topic = DEFAULT_JOINT_STATES_TOPIC, const std::string& = "") {
    state_monitor_->startStateMonitor(joint_states_topic);
  }
  void stopStateMonitor() { state_monitor_->stopStateMonitor(); }
  /** The next two need not do anything: move_group has the objects. */
  void startSceneMonitor(const std::string& = DEFAULT_PLANNING_SCENE_TOPIC) {}
  void startWorldGeometryMonitor() {}
  /** Set the scene's state to the robot's. */
  void updateSceneWithCurrentState();
  bool waitForCurrentRobotState(const ros::Time& t = ros::Time(), double wait_time = 1.0);

  void lockSceneRead() { lockSceneWrite(); }
  void unlockSceneRead() { mutex_.unlock(); }
  /** Lock the scene, and set its state to the robot's if that is watched. */
  void lockSceneWrite();
  void unlockSceneWrite() { mutex_.unlock(); }

 private:
  std::string name_;
  robot_model_loader::RobotModelLoaderPtr loader_;
  planning_scene::PlanningScenePtr scene_;
  CurrentStateMonitorPtr state_monitor_;
  std::recursive_mutex mutex_;
};

/** Scene that is locked as long as this exists. */
class LockedPlanningSceneRO {
 public:
  explicit LockedPlanningSceneRO(const PlanningSceneMonitorPtr& monitor) : monitor_(monitor) {
    monitor_->lockSceneRead();
  }
  ~LockedPlanningSceneRO() { monitor_->unlockSceneRead(); }
  LockedPlanningSceneRO(const LockedPlanningSceneRO&) = delete;
  LockedPlanningSceneRO& operator=(const LockedPlanningSceneRO&) = delete;

  operator bool() const { return static_cast<bool>(monitor_->getPlanningScene()); }
  operator planning_scene::PlanningSceneConstPtr() const { return monitor_->getPlanningScene(); }
  const planning_scene::PlanningScene* operator->() const { return monitor_->getPlanningScene().get(); }

 protected:
  PlanningSceneMonitorPtr monitor_;
};
class LockedPlanningSceneRW : public LockedPlanningSceneRO {
 public:
  using LockedPlanningSceneRO::LockedPlanningSceneRO;
  operator planning_scene::PlanningScenePtr() { return monitor_->getPlanningScene(); }
  planning_scene::PlanningScene* operator->() { return monitor_->getPlanningScene().get(); }
};

}  // namespace planning_scene_monitor
