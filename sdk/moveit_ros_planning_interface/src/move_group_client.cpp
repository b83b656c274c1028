#include "move_group_client.h"

#include <moveit_msgs/GetCartesianPath.h>
#include <moveit_msgs/GetPlannerParams.h>
#include <moveit_msgs/QueryPlannerInterfaces.h>
#include <moveit_msgs/SetPlannerParams.h>
#include <std_msgs/String.h>

#include "moveit/kinematic_constraints/utils.h"
#include "moveit/robot_model_loader/robot_model_loader.h"
#include "moveit/robot_state/conversions.h"

namespace moveit {
namespace planning_interface {
namespace {

constexpr double kToldWait = 5.0;  // [s] before it is said what is waited for

template <class Action>
void connect(std::unique_ptr<actionlib::SimpleActionClient<Action>>& client, ros::NodeHandle& node,
             const std::string& name, const ros::WallTime& end) {
  client.reset(new actionlib::SimpleActionClient<Action>(node, name, true));
  const ros::WallTime start = ros::WallTime::now();
  bool is_told = false;
  while (ros::ok() && !client->isServerConnected()) {
    const ros::WallTime now = ros::WallTime::now();
    if (!end.isZero() && now > end)
      throw std::runtime_error("Unable to connect to move_group action server '" + name + "' within allotted time");
    if (!is_told && (now - start).toSec() > kToldWait) {
      ROS_INFO_NAMED("move_group_interface", "Waiting for move_group action server '%s'; is move_group running?",
                     name.c_str());
      is_told = true;
    }
    ros::WallDuration(0.02).sleep();
  }
}

moveit::core::RobotModelConstPtr modelOf(const MoveGroupInterface::Options& options) {
  if (options.robot_model_) return options.robot_model_;
  const moveit::core::RobotModelConstPtr model =
      robot_model_loader::RobotModelLoader(options.robot_description_).getModel();
  if (!model) {
    throw std::runtime_error(
        "Unable to construct robot model. Please make sure all needed information is on the parameter server.");
  }
  return model;
}

}  // namespace

MoveGroupInterface::Implementation::Implementation(const Options& given, const ros::WallDuration& wait_for_servers)
    : options(given) {
  options.robot_model_ = modelOf(options);
  if (!options.robot_model_->hasJointModelGroup(options.group_name_))
    throw std::runtime_error("Group '" + options.group_name_ + "' was not found.");
  group_ = options.robot_model_->getJointModelGroup(options.group_name_);
  joint_target.reset(new moveit::core::RobotState(options.robot_model_));
  std::vector<std::string> tips;
  if (group_->getEndEffectorTips(tips) && tips.size() == 1) end_effector_link = tips.front();
  pose_frame = options.robot_model_->getModelFrame();
  workspace.header.frame_id = pose_frame;

  ros::NodeHandle& node = options.node_handle_;
  ros::NodeHandle planning(options.robot_description_ + "_planning");
  planning.param("default_velocity_scaling_factor", velocity_factor, 0.1);
  planning.param("default_acceleration_scaling_factor", acceleration_factor, 0.1);
  execution_events = node.advertise<std_msgs::String>("trajectory_execution_event", 1);
  attached_objects = node.advertise<moveit_msgs::AttachedCollisionObject>("attached_collision_object", 1);
  cartesian_path = node.serviceClient<moveit_msgs::GetCartesianPath>("compute_cartesian_path");
  planner_interfaces = node.serviceClient<moveit_msgs::QueryPlannerInterfaces>("query_planner_interface");
  planner_params = node.serviceClient<moveit_msgs::GetPlannerParams>("get_planner_params");
  set_planner_params = node.serviceClient<moveit_msgs::SetPlannerParams>("set_planner_params");
  monitor.reset(new planning_scene_monitor::CurrentStateMonitor(options.robot_model_));
  monitor->startStateMonitor();

  const ros::WallTime end = wait_for_servers.isZero() ? ros::WallTime() : ros::WallTime::now() + wait_for_servers;
  connect(move_action, node, "move_group", end);
  connect(execute_action, node, "execute_trajectory", end);
  // Not every move_group picks and places.
  pick_action.reset(new actionlib::SimpleActionClient<moveit_msgs::PickupAction>(node, "pickup", true));
  place_action.reset(new actionlib::SimpleActionClient<moveit_msgs::PlaceAction>(node, "place", true));
  ROS_INFO_STREAM_NAMED("move_group_interface",
                        "Ready to take commands for planning group " << options.group_name_ << ".");
}

moveit::core::RobotStatePtr MoveGroupInterface::Implementation::currentState(double wait_s) const {
  if (!monitor->waitForCompleteState(options.group_name_, wait_s)) {
    ROS_ERROR_NAMED("move_group_interface",
                    "Failed to fetch current robot state: not all joints of group '%s' are on joint_states",
                    options.group_name_.c_str());
    return nullptr;
  }
  return monitor->getCurrentState();
}

geometry_msgs::PoseStamped MoveGroupInterface::Implementation::poseOf(const moveit::core::RobotState& state,
                                                                      const std::string& name) const {
  geometry_msgs::PoseStamped result;
  result.header.frame_id = options.robot_model_->getModelFrame();
  result.header.stamp = ros::Time::now();
  if (!options.robot_model_->hasLinkModel(link(name))) {
    ROS_ERROR_NAMED("move_group_interface", "No end-effector specified");
    result.pose.orientation.w = 1.0;
    return result;
  }
  const Eigen::Isometry3d& pose = state.getGlobalLinkTransform(link(name));
  const Eigen::Quaterniond q(pose.linear());
  result.pose.position.x = pose.translation().x();
  result.pose.position.y = pose.translation().y();
  result.pose.position.z = pose.translation().z();
  result.pose.orientation.x = q.x();
  result.pose.orientation.y = q.y();
  result.pose.orientation.z = q.z();
  result.pose.orientation.w = q.w();
  return result;
}

bool MoveGroupInterface::Implementation::setPoses(const std::string& name,
                                                  const std::vector<geometry_msgs::PoseStamped>& poses) {
  if (poses.empty()) {
    ROS_ERROR_NAMED("move_group_interface", "No pose specified as goal target");
    return false;
  }
  if (link(name).empty()) {
    ROS_ERROR_NAMED("move_group_interface", "No end-effector to set the pose for");
    return false;
  }
  pose_targets[link(name)] = poses;
  return true;
}

moveit_msgs::Constraints MoveGroupInterface::Implementation::goal(const std::string& name,
                                                                  const geometry_msgs::PoseStamped& pose) const {
  moveit_msgs::Constraints result =
      kinematic_constraints::constructGoalConstraints(name, pose, position_tolerance, orientation_tolerance);
  if (target == Target::ORIENTATION) result.position_constraints.clear();
  if (target == Target::POSITION) result.orientation_constraints.clear();
  return result;
}

std::vector<moveit_msgs::Constraints> MoveGroupInterface::Implementation::goals() const {
  if (target == Target::JOINTS)
    return {kinematic_constraints::constructGoalConstraints(*joint_target, group_, joint_tolerance)};
  std::size_t count = 0;
  for (const auto& entry : pose_targets) count = std::max(count, entry.second.size());
  std::vector<moveit_msgs::Constraints> result(count);  // the i-th poses of all links belong together
  for (const auto& entry : pose_targets)
    for (std::size_t i = 0; i < entry.second.size(); ++i)
      result[i] = kinematic_constraints::mergeConstraints(goal(entry.first, entry.second[i]), result[i]);
  return result;
}

moveit_msgs::MotionPlanRequest MoveGroupInterface::Implementation::request() const {
  moveit_msgs::MotionPlanRequest result;
  result.group_name = options.group_name_;
  result.num_planning_attempts = static_cast<int>(planning_attempts);
  result.max_velocity_scaling_factor = velocity_factor;
  result.max_acceleration_scaling_factor = acceleration_factor;
  result.allowed_planning_time = planning_time;
  result.pipeline_id = planning_pipeline;
  result.planner_id = planner;
  result.workspace_parameters = workspace;
  result.start_state.is_diff = true;
  if (start_state) moveit::core::robotStateToRobotStateMsg(*start_state, result.start_state);
  result.goal_constraints = goals();
  result.path_constraints = path_constraints;
  return result;
}

moveit_msgs::PlanningOptions MoveGroupInterface::Implementation::planningOptions(bool plan_only) const {
  moveit_msgs::PlanningOptions result;
  result.plan_only = plan_only;
  result.look_around = can_look;
  result.replan = can_replan;
  result.replan_attempts = replan_attempts;
  result.replan_delay = replan_delay;
  result.planning_scene_diff.is_diff = true;
  result.planning_scene_diff.robot_state.is_diff = true;
  return result;
}

moveit_msgs::MoveGroupGoal MoveGroupInterface::Implementation::actionGoal(bool plan_only) const {
  moveit_msgs::MoveGroupGoal result;
  result.request = request();
  result.planning_options = planningOptions(plan_only);
  return result;
}

}  // namespace planning_interface
}  // namespace moveit
