#include "moveit/planning_scene_monitor/planning_scene_monitor.h"

namespace planning_scene_monitor {

const std::string PlanningSceneMonitor::DEFAULT_JOINT_STATES_TOPIC = "joint_states";
const std::string PlanningSceneMonitor::DEFAULT_PLANNING_SCENE_TOPIC = "planning_scene";

PlanningSceneMonitor::PlanningSceneMonitor(const robot_model_loader::RobotModelLoaderPtr& loader,
                                           const std::string& name)
    : name_(name), loader_(loader) {
  if (!loader_ || !loader_->getModel()) throw moveit::Exception("Robot model not loaded");
  scene_ = std::make_shared<planning_scene::PlanningScene>(loader_->getModel());
  state_monitor_ = std::make_shared<CurrentStateMonitor>(loader_->getModel());
}

void PlanningSceneMonitor::updateSceneWithCurrentState() {
  if (!state_monitor_->isActive()) return;
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  scene_->setCurrentState(*state_monitor_->getCurrentState());
}

bool PlanningSceneMonitor::waitForCurrentRobotState(const ros::Time& t, double wait_time) {
  if (!state_monitor_->waitForCurrentState(t, wait_time)) return false;
  updateSceneWithCurrentState();
  return true;
}

void PlanningSceneMonitor::lockSceneWrite() {
  mutex_.lock();
  updateSceneWithCurrentState();
}

}  // namespace planning_scene_monitor
