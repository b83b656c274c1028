#include <moveit_msgs/GetCartesianPath.h>
#include <moveit_msgs/GetPlannerParams.h>
#include <moveit_msgs/QueryPlannerInterfaces.h>
#include <moveit_msgs/SetPlannerParams.h>
#include <std_msgs/String.h>

#include <algorithm>

#include "move_group_client.h"
#include "moveit/robot_state/conversions.h"

namespace moveit {
namespace planning_interface {
namespace {

using moveit_msgs::MoveItErrorCodes;

/** Links that may touch what an end effector holds: its own. */
std::vector<std::string> touchLinks(const moveit::core::RobotModel& model, const std::string& end_effector) {
  const moveit::core::JointModelGroup* group = model.getEndEffector(end_effector);
  return group == nullptr ? std::vector<std::string>() : group->getLinkModelNames();
}

}  // namespace

bool MoveGroupInterface::getInterfaceDescription(moveit_msgs::PlannerInterfaceDescription& description) const {
  moveit_msgs::QueryPlannerInterfaces question;
  if (!impl_->planner_interfaces.call(question) || question.response.planner_interfaces.empty()) return false;
  description = question.response.planner_interfaces.front();
  return true;
}

std::map<std::string, std::string> MoveGroupInterface::getPlannerParams(const std::string& planner_id,
                                                                        const std::string& group) const {
  moveit_msgs::GetPlannerParams question;
  question.request.planner_config = planner_id;
  question.request.group = group;
  std::map<std::string, std::string> result;
  if (!impl_->planner_params.call(question)) return result;
  const moveit_msgs::PlannerParams& params = question.response.params;
  for (std::size_t i = 0; i < std::min(params.keys.size(), params.values.size()); ++i)
    result[params.keys[i]] = params.values[i];
  return result;
}

void MoveGroupInterface::setPlannerParams(const std::string& planner_id, const std::string& group,
                                          const std::map<std::string, std::string>& params, bool replace) {
  moveit_msgs::SetPlannerParams question;
  question.request.planner_config = planner_id;
  question.request.group = group;
  question.request.replace = replace;
  for (const auto& entry : params) {
    question.request.params.keys.push_back(entry.first);
    question.request.params.values.push_back(entry.second);
  }
  impl_->set_planner_params.call(question);
}

std::string MoveGroupInterface::getDefaultPlannerId(const std::string& group) const {
  std::string result;
  ros::NodeHandle node("move_group");
  if (group.empty() || !node.getParam(group + "/default_planner_config", result))
    node.getParam("default_planner_config", result);
  return result;
}

void MoveGroupInterface::setPlannerId(const std::string& planner_id) { impl_->planner = planner_id; }
const std::string& MoveGroupInterface::getPlannerId() const { return impl_->planner; }
void MoveGroupInterface::setPlanningPipelineId(const std::string& pipeline_id) {
  impl_->planning_pipeline = pipeline_id;
}
const std::string& MoveGroupInterface::getPlanningPipelineId() const { return impl_->planning_pipeline; }
void MoveGroupInterface::setPlanningTime(double seconds) {
  if (seconds > 0.0) impl_->planning_time = seconds;
}
double MoveGroupInterface::getPlanningTime() const { return impl_->planning_time; }
void MoveGroupInterface::setNumPlanningAttempts(unsigned int attempts) { impl_->planning_attempts = attempts; }
void MoveGroupInterface::setMaxVelocityScalingFactor(double factor) { impl_->velocity_factor = factor; }
void MoveGroupInterface::setMaxAccelerationScalingFactor(double factor) { impl_->acceleration_factor = factor; }
void MoveGroupInterface::allowLooking(bool flag) { impl_->can_look = flag; }
void MoveGroupInterface::allowReplanning(bool flag) { impl_->can_replan = flag; }
void MoveGroupInterface::setReplanAttempts(int attempts) { impl_->replan_attempts = std::max(attempts, 0); }
void MoveGroupInterface::setReplanDelay(double seconds) { impl_->replan_delay = std::max(seconds, 0.0); }
void MoveGroupInterface::constructMotionPlanRequest(moveit_msgs::MotionPlanRequest& request) const {
  request = impl_->request();
}

actionlib::SimpleActionClient<moveit_msgs::MoveGroupAction>& MoveGroupInterface::getMoveGroupClient() const {
  return *impl_->move_action;
}

MoveItErrorCode MoveGroupInterface::asyncMove() {
  impl_->move_action->sendGoal(impl_->actionGoal(false));
  return MoveItErrorCodes::SUCCESS;
}

MoveItErrorCode MoveGroupInterface::move() {
  return impl_->run(*impl_->move_action, impl_->actionGoal(false), "move_group");
}

MoveItErrorCode MoveGroupInterface::plan(Plan& plan) {
  const MoveItErrorCode code = impl_->run(*impl_->move_action, impl_->actionGoal(true), "move_group");
  const auto result = impl_->move_action->getResult();
  if (!result) return code;
  plan.trajectory_ = result->planned_trajectory;
  plan.start_state_ = result->trajectory_start;
  plan.planning_time_ = result->planning_time;
  return code;
}

MoveItErrorCode MoveGroupInterface::asyncExecute(const moveit_msgs::RobotTrajectory& trajectory) {
  moveit_msgs::ExecuteTrajectoryGoal goal;
  goal.trajectory = trajectory;
  impl_->execute_action->sendGoal(goal);
  return MoveItErrorCodes::SUCCESS;
}

MoveItErrorCode MoveGroupInterface::execute(const moveit_msgs::RobotTrajectory& trajectory) {
  moveit_msgs::ExecuteTrajectoryGoal goal;
  goal.trajectory = trajectory;
  return impl_->run(*impl_->execute_action, goal, "execute_trajectory");
}

double MoveGroupInterface::computeCartesianPath(const std::vector<geometry_msgs::Pose>& waypoints, double eef_step,
                                                double jump_threshold, moveit_msgs::RobotTrajectory& trajectory,
                                                bool avoid_collisions, moveit_msgs::MoveItErrorCodes* error_code) {
  return computeCartesianPath(waypoints, eef_step, jump_threshold, trajectory, moveit_msgs::Constraints(),
                              avoid_collisions, error_code);
}

double MoveGroupInterface::computeCartesianPath(const std::vector<geometry_msgs::Pose>& waypoints, double eef_step,
                                                double jump_threshold, moveit_msgs::RobotTrajectory& trajectory,
                                                const moveit_msgs::Constraints& path_constraints, bool avoid_collisions,
                                                moveit_msgs::MoveItErrorCodes* error_code) {
  moveit_msgs::GetCartesianPath question;
  question.request.start_state.is_diff = true;
  if (impl_->start_state) moveit::core::robotStateToRobotStateMsg(*impl_->start_state, question.request.start_state);
  question.request.group_name = getName();
  question.request.header.frame_id = impl_->pose_frame;
  question.request.header.stamp = ros::Time::now();
  question.request.waypoints = waypoints;
  question.request.max_step = eef_step;
  question.request.jump_threshold = jump_threshold;
  question.request.path_constraints = path_constraints;
  question.request.avoid_collisions = avoid_collisions;
  question.request.link_name = impl_->end_effector_link;
  if (!impl_->cartesian_path.call(question)) {
    if (error_code != nullptr) error_code->val = MoveItErrorCodes::FAILURE;
    return -1.0;
  }
  if (error_code != nullptr) *error_code = question.response.error_code;
  if (question.response.error_code.val != MoveItErrorCodes::SUCCESS) return -1.0;
  trajectory = question.response.solution;
  return question.response.fraction;
}

void MoveGroupInterface::stop() {
  std_msgs::String event;
  event.data = "stop";
  impl_->execution_events.publish(event);
}

MoveItErrorCode MoveGroupInterface::pick(const std::string& object, const std::vector<moveit_msgs::Grasp>& grasps,
                                         bool plan_only) {
  moveit_msgs::PickupGoal goal;
  goal.target_name = object;
  goal.group_name = getName();
  goal.end_effector = getEndEffector();
  goal.support_surface_name = impl_->support_surface;
  goal.possible_grasps = grasps;
  if (!impl_->support_surface.empty()) goal.allow_gripper_support_collision = true;
  goal.path_constraints = impl_->path_constraints;
  goal.planner_id = impl_->planner;
  goal.allowed_planning_time = impl_->planning_time;
  goal.planning_options = impl_->planningOptions(plan_only);
  return impl_->run(*impl_->pick_action, goal, "pickup");
}

MoveItErrorCode MoveGroupInterface::place(const std::string& object,
                                          const std::vector<moveit_msgs::PlaceLocation>& locations, bool plan_only) {
  moveit_msgs::PlaceGoal goal;
  goal.attached_object_name = object;
  goal.group_name = getName();
  goal.place_locations = locations;
  goal.support_surface_name = impl_->support_surface;
  if (!impl_->support_surface.empty()) goal.allow_gripper_support_collision = true;
  goal.path_constraints = impl_->path_constraints;
  goal.planner_id = impl_->planner;
  goal.allowed_planning_time = impl_->planning_time;
  goal.planning_options = impl_->planningOptions(plan_only);
  return impl_->run(*impl_->place_action, goal, "place");
}

MoveItErrorCode MoveGroupInterface::place(const std::string& object,
                                          const std::vector<geometry_msgs::PoseStamped>& poses, bool plan_only) {
  std::vector<moveit_msgs::PlaceLocation> locations;
  for (const geometry_msgs::PoseStamped& pose : poses) {
    moveit_msgs::PlaceLocation location;
    location.place_pose = pose;
    location.pre_place_approach.direction.vector.z = -1.0;
    location.post_place_retreat.direction.vector.x = -1.0;
    location.pre_place_approach.direction.header.frame_id = getPlanningFrame();
    location.post_place_retreat.direction.header.frame_id = impl_->end_effector_link;
    location.pre_place_approach.min_distance = location.post_place_retreat.min_distance = 0.1;
    location.pre_place_approach.desired_distance = location.post_place_retreat.desired_distance = 0.2;
    locations.push_back(location);
  }
  return place(object, locations, plan_only);
}

bool MoveGroupInterface::attachObject(const std::string& object, const std::string& link) {
  return attachObject(object, link, std::vector<std::string>());
}

bool MoveGroupInterface::attachObject(const std::string& object, const std::string& link,
                                      const std::vector<std::string>& touch_links) {
  const std::string holder =
      impl_->link(link).empty() && !getLinkNames().empty() ? getLinkNames().back() : impl_->link(link);
  if (holder.empty()) {
    ROS_ERROR_NAMED("move_group_interface", "No known link to attach object '%s' to", object.c_str());
    return false;
  }
  moveit_msgs::AttachedCollisionObject body;
  body.object.id = object;
  body.link_name = holder;
  body.touch_links = touch_links.empty() ? touchLinks(*getRobotModel(), getEndEffector()) : touch_links;
  if (body.touch_links.empty()) body.touch_links.push_back(holder);
  body.object.operation = moveit_msgs::CollisionObject::ADD;
  impl_->attached_objects.publish(body);
  return true;
}

bool MoveGroupInterface::detachObject(const std::string& name) {
  moveit_msgs::AttachedCollisionObject body;
  if (!name.empty() && getRobotModel()->hasLinkModel(name)) body.link_name = name;  // all that it holds
  else body.object.id = name;
  body.object.operation = moveit_msgs::CollisionObject::REMOVE;
  if (body.link_name.empty() && body.object.id.empty()) {
    const std::vector<std::string>& links = getLinkNames();
    if (links.empty()) return false;
    for (const std::string& link : links) {
      body.link_name = link;
      impl_->attached_objects.publish(body);
    }
    return true;
  }
  impl_->attached_objects.publish(body);
  return true;
}

}  // namespace planning_interface
}  // namespace moveit
