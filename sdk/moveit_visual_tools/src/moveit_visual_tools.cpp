#include "moveit_visual_tools/moveit_visual_tools.h"

#include <moveit/robot_model_loader/robot_model_loader.h>
#include <moveit/robot_state/conversions.h>

namespace moveit_visual_tools {
namespace {

moveit::core::RobotModelConstPtr loadedModel() {
  return robot_model_loader::RobotModelLoader(ROBOT_DESCRIPTION).getModel();
}

std::string rootFrame(const moveit::core::RobotModelConstPtr& model) {
  return model ? model->getModelFrame() : "world";
}

/** Names of the links that have a shape for collisions. */
std::vector<std::string> shapedLinks(const moveit::core::RobotModel& model) {
  std::vector<std::string> result;
  for (const moveit::core::LinkModel* const link : model.getLinkModels())
    if (link->hasCollisionGeometry()) result.push_back(link->getName());
  return result;
}

}  // namespace

MoveItVisualTools::MoveItVisualTools() : MoveItVisualTools("", rvt::RVIZ_MARKER_TOPIC, loadedModel()) {
  setBaseFrame(rootFrame(robot_model_));
}

MoveItVisualTools::MoveItVisualTools(const std::string& base_frame, const std::string& marker_topic,
                                     const planning_scene_monitor::PlanningSceneMonitorPtr& monitor)
    : MoveItVisualTools(base_frame, marker_topic,
                        monitor ? monitor->getRobotModel() : moveit::core::RobotModelConstPtr()) {}

MoveItVisualTools::MoveItVisualTools(const std::string& base_frame, const std::string& marker_topic,
                                     const moveit::core::RobotModelConstPtr& robot_model)
    : RvizVisualTools(base_frame, marker_topic), robot_model_(robot_model) {}

bool MoveItVisualTools::loadSharedRobotState() {
  if (state_) return true;
  if (!robot_model_) robot_model_ = loadedModel();
  if (!robot_model_) return false;
  state_ = std::make_shared<moveit::core::RobotState>(robot_model_);
  state_->setToDefaultValues();
  return true;
}

moveit::core::RobotStatePtr& MoveItVisualTools::getSharedRobotState() {
  loadSharedRobotState();
  return state_;
}

moveit::core::RobotModelConstPtr MoveItVisualTools::getRobotModel() {
  loadSharedRobotState();
  return robot_model_;
}

void MoveItVisualTools::loadTrajectoryPub(const std::string& topic, bool) {
  if (!trajectories_) trajectories_ = nh_.advertise<moveit_msgs::DisplayTrajectory>(topic, 10, true);
}

void MoveItVisualTools::loadRobotStatePub(const std::string& topic, bool) {
  if (!topic.empty()) robot_state_topic_ = topic;
  if (!robot_states_) robot_states_ = nh_.advertise<moveit_msgs::DisplayRobotState>(robot_state_topic_, 1, true);
}

bool MoveItVisualTools::publishTrajectoryLine(const moveit_msgs::RobotTrajectory& trajectory,
                                              const moveit::core::LinkModel* tip,
                                              const moveit::core::JointModelGroup* group, rvt::Colors color) {
  if (!group || !loadSharedRobotState()) return false;
  robot_trajectory::RobotTrajectory states(robot_model_, group->getName());
  states.setRobotTrajectoryMsg(*state_, trajectory);
  return publishTrajectoryLine(states, tip, color);
}

bool MoveItVisualTools::publishTrajectoryLine(const moveit_msgs::RobotTrajectory& trajectory,
                                              const moveit::core::JointModelGroup* group, rvt::Colors color) {
  if (!group || !loadSharedRobotState()) return false;
  robot_trajectory::RobotTrajectory states(robot_model_, group->getName());
  states.setRobotTrajectoryMsg(*state_, trajectory);
  return publishTrajectoryLine(states, group, color);
}

bool MoveItVisualTools::publishTrajectoryLine(const robot_trajectory::RobotTrajectory& trajectory,
                                              const moveit::core::LinkModel* tip, rvt::Colors color) {
  if (!tip) {
    ROS_FATAL("tip_link is NULL");
    return false;
  }
  std::vector<geometry_msgs::Point> way;
  for (std::size_t i = 0; i < trajectory.getWayPointCount(); ++i)
    way.push_back(
        convertPoint(Eigen::Vector3d(trajectory.getWayPoint(i).getGlobalLinkTransform(tip->getName()).translation())));
  if (way.empty()) {
    ROS_ERROR("Unable to publish trajectory line: it has no states");
    return false;
  }
  if (way.size() == 1) return publishSpheres(way, color, 0.01);
  return publishPath(way, color, 0.005);
}

bool MoveItVisualTools::publishTrajectoryLine(const robot_trajectory::RobotTrajectory& trajectory,
                                              const moveit::core::JointModelGroup* group, rvt::Colors color) {
  std::vector<const moveit::core::LinkModel*> tips;
  if (!group || !group->getEndEffectorTips(tips) || tips.empty()) {
    ROS_ERROR("Unable to get end effector tips from jmg");
    return false;
  }
  bool is_shown = true;
  for (const moveit::core::LinkModel* const tip : tips)
    is_shown = publishTrajectoryLine(trajectory, tip, color) && is_shown;
  return is_shown;
}

bool MoveItVisualTools::publishTrajectoryPath(const std::vector<moveit::core::RobotStatePtr>& trajectory,
                                              const moveit::core::JointModelGroup* group, double speed, bool blocking) {
  if (!group || !loadSharedRobotState()) return false;
  robot_trajectory::RobotTrajectory states(robot_model_, group->getName());
  for (std::size_t i = 0; i < trajectory.size(); ++i)
    states.addSuffixWayPoint(*trajectory[i], i == 0 ? 0.0 : (speed > 0.0 ? speed : 0.01));
  return publishTrajectoryPath(states, blocking);
}

bool MoveItVisualTools::publishTrajectoryPath(const robot_trajectory::RobotTrajectory& trajectory, bool blocking) {
  if (trajectory.empty()) {
    ROS_WARN("Unable to publish trajectory path because trajectory has zero points");
    return false;
  }
  moveit_msgs::RobotTrajectory message;
  trajectory.getRobotTrajectoryMsg(message);
  return publishTrajectoryPath(message, trajectory.getFirstWayPoint(), blocking);
}

bool MoveItVisualTools::publishTrajectoryPath(const moveit_msgs::RobotTrajectory& trajectory,
                                              const moveit::core::RobotState& state, bool blocking) {
  moveit_msgs::RobotState start;
  moveit::core::robotStateToRobotStateMsg(state, start);
  return publishTrajectoryPath(trajectory, start, blocking);
}

bool MoveItVisualTools::publishTrajectoryPath(const moveit_msgs::RobotTrajectory& trajectory,
                                              const moveit_msgs::RobotState& state, bool blocking) {
  if (!loadSharedRobotState()) return false;
  loadTrajectoryPub();
  moveit_msgs::DisplayTrajectory shown;
  shown.model_id = robot_model_->getName();
  shown.trajectory_start = state;
  shown.trajectory.push_back(trajectory);
  trajectories_.publish(shown);
  const auto& points = trajectory.joint_trajectory.points;
  if (blocking && !points.empty()) points.back().time_from_start.sleep();
  return true;
}

bool MoveItVisualTools::publishRobotState(const moveit::core::RobotState& state, rvt::Colors color,
                                          const std::vector<std::string>& highlight_links) {
  loadRobotStatePub();
  moveit_msgs::DisplayRobotState shown;
  moveit::core::robotStateToRobotStateMsg(state, shown.state);
  if (color != rvt::DEFAULT) {
    const auto links = highlight_links.empty() ? shapedLinks(*state.getRobotModel()) : highlight_links;
    for (const std::string& link : links) {
      moveit_msgs::ObjectColor colored;
      colored.id = link;
      colored.color = getColor(color);
      shown.highlight_links.push_back(colored);
    }
  }
  robot_states_.publish(shown);
  return true;
}

bool MoveItVisualTools::publishRobotState(const std::vector<double>& joint_positions,
                                          const moveit::core::JointModelGroup* group, rvt::Colors color) {
  if (!group || !loadSharedRobotState()) return false;
  if (joint_positions.size() != group->getVariableCount()) {
    ROS_ERROR("The state has %zu positions, group '%s' %u variables", joint_positions.size(), group->getName().c_str(),
              group->getVariableCount());
    return false;
  }
  state_->setJointGroupPositions(group, joint_positions);
  return publishRobotState(*state_, color);
}

bool MoveItVisualTools::hideRobot() {
  if (!loadSharedRobotState()) return false;
  loadRobotStatePub();
  moveit_msgs::DisplayRobotState shown;
  moveit::core::robotStateToRobotStateMsg(*state_, shown.state);
  for (const std::string& link : shapedLinks(*robot_model_)) {
    moveit_msgs::ObjectColor clear;
    clear.id = link;
    shown.highlight_links.push_back(clear);
  }
  robot_states_.publish(shown);
  return true;
}

}  // namespace moveit_visual_tools
