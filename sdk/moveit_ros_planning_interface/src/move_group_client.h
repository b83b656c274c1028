#pragma once

#include <moveit_msgs/ExecuteTrajectoryAction.h>
#include <moveit_msgs/PickupAction.h>
#include <moveit_msgs/PlaceAction.h>

#include "moveit/move_group_interface/move_group_interface.h"
#include "moveit/planning_scene_monitor/current_state_monitor.h"

namespace moveit {
namespace planning_interface {

/** What was set for a group, and the connections to move_group. */
class MoveGroupInterface::Implementation {
 public:
  Implementation(const Options& options, const ros::WallDuration& wait_for_servers);

  const moveit::core::JointModelGroup& group() const { return *group_; }
  /** Link that poses are for; an empty name means the end effector's. */
  const std::string& link(const std::string& name) const { return name.empty() ? end_effector_link : name; }
  moveit::core::RobotStatePtr currentState(double wait_s) const;
  /** Pose of a link in the planning frame. */
  geometry_msgs::PoseStamped poseOf(const moveit::core::RobotState& state, const std::string& name) const;
  bool setPoses(const std::string& name, const std::vector<geometry_msgs::PoseStamped>& poses);
  moveit_msgs::Constraints goal(const std::string& name, const geometry_msgs::PoseStamped& pose) const;
  std::vector<moveit_msgs::Constraints> goals() const;
  moveit_msgs::MotionPlanRequest request() const;
  moveit_msgs::MoveGroupGoal actionGoal(bool plan_only) const;
  moveit_msgs::PlanningOptions planningOptions(bool plan_only) const;

  /** Send a goal and wait for its end. */
  template <class Action, class Goal>
  MoveItErrorCode run(actionlib::SimpleActionClient<Action>& client, const Goal& goal, const char* name) const {
    if (!client.isServerConnected()) {
      ROS_ERROR_NAMED("move_group_interface", "move_group's action %s is not there", name);
      return moveit_msgs::MoveItErrorCodes::COMMUNICATION_FAILURE;
    }
    client.sendGoal(goal);
    if (!client.waitForResult())
      ROS_INFO_STREAM_NAMED("move_group_interface", "the action " << name << " returned early");
    const auto result = client.getResult();
    if (client.getState() != actionlib::SimpleClientGoalState::SUCCEEDED) {
      ROS_WARN_STREAM_NAMED("move_group_interface",
                            "Fail: " << client.getState().toString() << ": " << client.getState().getText());
    }
    return result ? MoveItErrorCode(result->error_code) : MoveItErrorCode(moveit_msgs::MoveItErrorCodes::FAILURE);
  }

  Options options;
  std::string planning_pipeline, planner, end_effector_link, pose_frame, support_surface;
  double planning_time = 5.0, velocity_factor = 0.1, acceleration_factor = 0.1;
  unsigned int planning_attempts = 1;
  double joint_tolerance = 1e-4, position_tolerance = 1e-4, orientation_tolerance = 1e-3;
  bool can_look = false, can_replan = false;
  int replan_attempts = 1;
  double replan_delay = 2.0;
  enum class Target { JOINTS, POSES, POSITION, ORIENTATION } target = Target::JOINTS;
  std::unique_ptr<moveit::core::RobotState> joint_target, start_state;
  std::map<std::string, std::vector<geometry_msgs::PoseStamped>> pose_targets;
  std::map<std::string, std::vector<double>> remembered;
  moveit_msgs::WorkspaceParameters workspace;
  moveit_msgs::Constraints path_constraints;

  std::unique_ptr<planning_scene_monitor::CurrentStateMonitor> monitor;
  std::unique_ptr<actionlib::SimpleActionClient<moveit_msgs::MoveGroupAction>> move_action;
  std::unique_ptr<actionlib::SimpleActionClient<moveit_msgs::ExecuteTrajectoryAction>> execute_action;
  std::unique_ptr<actionlib::SimpleActionClient<moveit_msgs::PickupAction>> pick_action;
  std::unique_ptr<actionlib::SimpleActionClient<moveit_msgs::PlaceAction>> place_action;
  ros::Publisher execution_events, attached_objects;
  ros::ServiceClient cartesian_path, planner_interfaces, planner_params, set_planner_params;

 private:
  const moveit::core::JointModelGroup* group_ = nullptr;
};

}  // namespace planning_interface
}  // namespace moveit
