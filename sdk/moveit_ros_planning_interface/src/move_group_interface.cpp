#include <moveit_msgs/GetCartesianPath.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <cmath>

#include "move_group_client.h"
#include "moveit/robot_state/conversions.h"

namespace moveit {
namespace planning_interface {
namespace {

Eigen::Isometry3d isometry(const geometry_msgs::Pose& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = Eigen::Quaterniond(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z)
                        .normalized()
                        .toRotationMatrix();
  result.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return result;
}

geometry_msgs::Pose message(const Eigen::Isometry3d& pose) {
  geometry_msgs::Pose result;
  const Eigen::Quaterniond q(pose.linear());
  result.position.x = pose.translation().x();
  result.position.y = pose.translation().y();
  result.position.z = pose.translation().z();
  result.orientation.x = q.x();
  result.orientation.y = q.y();
  result.orientation.z = q.z();
  result.orientation.w = q.w();
  return result;
}

}  // namespace

const std::string MoveGroupInterface::ROBOT_DESCRIPTION = "robot_description";

MoveGroupInterface::MoveGroupInterface(const Options& options, const std::shared_ptr<tf2_ros::Buffer>&,
                                       const ros::WallDuration& wait_for_servers)
    : impl_(new Implementation(options, wait_for_servers)) {}
MoveGroupInterface::~MoveGroupInterface() = default;
MoveGroupInterface::MoveGroupInterface(MoveGroupInterface&& other) noexcept = default;
MoveGroupInterface& MoveGroupInterface::operator=(MoveGroupInterface&& other) noexcept = default;

const std::string& MoveGroupInterface::getName() const { return impl_->options.group_name_; }
moveit::core::RobotModelConstPtr MoveGroupInterface::getRobotModel() const { return impl_->options.robot_model_; }
const ros::NodeHandle& MoveGroupInterface::getNodeHandle() const { return impl_->options.node_handle_; }
const std::string& MoveGroupInterface::getPlanningFrame() const { return impl_->options.robot_model_->getModelFrame(); }
const std::vector<std::string>& MoveGroupInterface::getJointModelGroupNames() const {
  return impl_->options.robot_model_->getJointModelGroupNames();
}
const std::vector<std::string>& MoveGroupInterface::getJointNames() const { return impl_->group().getVariableNames(); }
const std::vector<std::string>& MoveGroupInterface::getLinkNames() const { return impl_->group().getLinkModelNames(); }
const std::vector<std::string>& MoveGroupInterface::getActiveJoints() const {
  return impl_->group().getActiveJointModelNames();
}
const std::vector<std::string>& MoveGroupInterface::getJoints() const { return impl_->group().getJointModelNames(); }
unsigned int MoveGroupInterface::getVariableCount() const { return impl_->group().getVariableCount(); }

std::vector<std::string> MoveGroupInterface::getNamedTargets() const {
  std::vector<std::string> result = impl_->group().getDefaultStateNames();
  for (const auto& entry : impl_->remembered) result.push_back(entry.first);
  return result;
}

std::map<std::string, double> MoveGroupInterface::getNamedTargetValues(const std::string& name) const {
  std::map<std::string, double> result;
  const auto found = impl_->remembered.find(name);
  if (found == impl_->remembered.end()) {
    if (!impl_->group().getVariableDefaultPositions(name, result)) {
      ROS_ERROR_NAMED("move_group_interface",
                      "The requested named target '%s' does not exist, returning empty positions.", name.c_str());
    }
    return result;
  }
  const std::vector<std::string>& names = impl_->group().getVariableNames();
  for (std::size_t i = 0; i < std::min(names.size(), found->second.size()); ++i) result[names[i]] = found->second[i];
  return result;
}

void MoveGroupInterface::setGoalTolerance(double tolerance) {
  setGoalJointTolerance(tolerance);
  setGoalPositionTolerance(tolerance);
  setGoalOrientationTolerance(tolerance);
}
void MoveGroupInterface::setGoalJointTolerance(double tolerance) { impl_->joint_tolerance = tolerance; }
void MoveGroupInterface::setGoalPositionTolerance(double tolerance) { impl_->position_tolerance = tolerance; }
void MoveGroupInterface::setGoalOrientationTolerance(double tolerance) { impl_->orientation_tolerance = tolerance; }
double MoveGroupInterface::getGoalJointTolerance() const { return impl_->joint_tolerance; }
double MoveGroupInterface::getGoalPositionTolerance() const { return impl_->position_tolerance; }
double MoveGroupInterface::getGoalOrientationTolerance() const { return impl_->orientation_tolerance; }

void MoveGroupInterface::setWorkspace(double minx, double miny, double minz, double maxx, double maxy, double maxz) {
  impl_->workspace.header.frame_id = getPlanningFrame();
  impl_->workspace.header.stamp = ros::Time::now();
  impl_->workspace.min_corner.x = minx;
  impl_->workspace.min_corner.y = miny;
  impl_->workspace.min_corner.z = minz;
  impl_->workspace.max_corner.x = maxx;
  impl_->workspace.max_corner.y = maxy;
  impl_->workspace.max_corner.z = maxz;
}

void MoveGroupInterface::setStartState(const moveit_msgs::RobotState& start_state) {
  moveit::core::RobotStatePtr state =
      start_state.is_diff ? getCurrentState() : std::make_shared<moveit::core::RobotState>(getRobotModel());
  if (!state) return;
  moveit::core::robotStateMsgToRobotState(start_state, *state);
  setStartState(*state);
}
void MoveGroupInterface::setStartState(const moveit::core::RobotState& start_state) {
  impl_->start_state.reset(new moveit::core::RobotState(start_state));
}
void MoveGroupInterface::setStartStateToCurrentState() { impl_->start_state.reset(); }
void MoveGroupInterface::setSupportSurfaceName(const std::string& name) { impl_->support_surface = name; }

bool MoveGroupInterface::setJointValueTarget(const std::vector<double>& group_variable_values) {
  const std::size_t all = impl_->group().getVariableCount();
  const bool are_active = group_variable_values.size() != all &&
                          group_variable_values.size() == impl_->group().getActiveJointModelNames().size();
  if (group_variable_values.size() != all && !are_active) {
    ROS_ERROR_NAMED("move_group_interface", "Provided joint value list has length %zu but group %s has %zu joints",
                    group_variable_values.size(), getName().c_str(), all);
    return false;
  }
  impl_->target = Implementation::Target::JOINTS;
  if (are_active) impl_->joint_target->setJointGroupActivePositions(&impl_->group(), group_variable_values);
  else impl_->joint_target->setJointGroupPositions(&impl_->group(), group_variable_values);
  return impl_->joint_target->satisfiesBounds(&impl_->group(), impl_->joint_tolerance);
}

bool MoveGroupInterface::setJointValueTarget(const std::map<std::string, double>& variable_values) {
  const std::vector<std::string>& names = impl_->group().getVariableNames();
  for (const auto& entry : variable_values) {
    if (std::find(names.begin(), names.end(), entry.first) != names.end()) continue;
    ROS_ERROR_STREAM_NAMED("move_group_interface",
                           "joint variable " << entry.first << " is not part of group " << getName());
    return false;
  }
  impl_->target = Implementation::Target::JOINTS;
  impl_->joint_target->setVariablePositions(variable_values);
  return impl_->joint_target->satisfiesBounds(&impl_->group(), impl_->joint_tolerance);
}

bool MoveGroupInterface::setJointValueTarget(const std::vector<std::string>& variable_names,
                                             const std::vector<double>& variable_values) {
  if (variable_names.size() != variable_values.size()) {
    ROS_ERROR_NAMED("move_group_interface", "sizes of name and position arrays do not match");
    return false;
  }
  std::map<std::string, double> values;
  for (std::size_t i = 0; i < variable_names.size(); ++i) values[variable_names[i]] = variable_values[i];
  return setJointValueTarget(values);
}

bool MoveGroupInterface::setJointValueTarget(const moveit::core::RobotState& state) {
  impl_->target = Implementation::Target::JOINTS;
  *impl_->joint_target = state;
  return impl_->joint_target->satisfiesBounds(&impl_->group(), impl_->joint_tolerance);
}

bool MoveGroupInterface::setJointValueTarget(const std::string& joint_name, double value) {
  return setJointValueTarget(joint_name, std::vector<double>{value});
}

bool MoveGroupInterface::setJointValueTarget(const std::string& joint_name, const std::vector<double>& values) {
  const moveit::core::JointModel* joint = impl_->group().getJointModel(joint_name);
  if (joint == nullptr || joint->getVariableCount() != values.size()) {
    ROS_ERROR_STREAM_NAMED("move_group_interface", "joint " << joint_name << " of group " << getName()
                                                            << " does not take " << values.size() << " values");
    return false;
  }
  impl_->target = Implementation::Target::JOINTS;
  impl_->joint_target->setJointPositions(joint, values.data());
  return impl_->joint_target->satisfiesBounds(joint, impl_->joint_tolerance);
}

bool MoveGroupInterface::setJointValueTarget(const sensor_msgs::JointState& state) {
  return setJointValueTarget(state.name, state.position);
}

bool MoveGroupInterface::setJointValueTarget(const geometry_msgs::Pose& eef_pose,
                                             const std::string& end_effector_link) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = impl_->pose_frame;
  pose.pose = eef_pose;
  return setJointValueTarget(pose, end_effector_link);
}

bool MoveGroupInterface::setJointValueTarget(const geometry_msgs::PoseStamped& eef_pose,
                                             const std::string& end_effector_link) {
  impl_->target = Implementation::Target::JOINTS;
  moveit::core::RobotState& state = *impl_->joint_target;
  const std::string& frame = eef_pose.header.frame_id;
  if (!frame.empty() && !state.knowsFrameTransform(frame)) {
    ROS_ERROR_NAMED("move_group_interface", "frame '%s' is none of the robot's", frame.c_str());
    return false;
  }
  const Eigen::Isometry3d pose =
      (frame.empty() ? Eigen::Isometry3d::Identity() : state.getFrameTransform(frame)) * isometry(eef_pose.pose);
  return state.setFromIK(&impl_->group(), pose, impl_->link(end_effector_link));
}

bool MoveGroupInterface::setJointValueTarget(const Eigen::Isometry3d& eef_pose, const std::string& end_effector_link) {
  return setJointValueTarget(message(eef_pose), end_effector_link);
}

void MoveGroupInterface::getJointValueTarget(std::vector<double>& group_variable_values) const {
  impl_->joint_target->copyJointGroupPositions(&impl_->group(), group_variable_values);
}
const moveit::core::RobotState& MoveGroupInterface::getJointValueTarget() const { return *impl_->joint_target; }

void MoveGroupInterface::setRandomTarget() {
  impl_->target = Implementation::Target::JOINTS;
  impl_->joint_target->setToRandomPositions(&impl_->group());
}

bool MoveGroupInterface::setNamedTarget(const std::string& name) {
  const auto found = impl_->remembered.find(name);
  if (found != impl_->remembered.end()) return setJointValueTarget(found->second);
  if (impl_->joint_target->setToDefaultValues(&impl_->group(), name)) {
    impl_->target = Implementation::Target::JOINTS;
    return true;
  }
  ROS_ERROR_NAMED("move_group_interface", "The requested named target '%s' does not exist", name.c_str());
  return false;
}

bool MoveGroupInterface::setPositionTarget(double x, double y, double z, const std::string& end_effector_link) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = impl_->pose_frame;
  pose.pose.position.x = x;
  pose.pose.position.y = y;
  pose.pose.position.z = z;
  pose.pose.orientation.w = 1.0;
  impl_->target = Implementation::Target::POSITION;
  return impl_->setPoses(end_effector_link, {pose});
}

bool MoveGroupInterface::setRPYTarget(double roll, double pitch, double yaw, const std::string& end_effector_link) {
  const Eigen::Quaterniond q = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
  return setOrientationTarget(q.x(), q.y(), q.z(), q.w(), end_effector_link);
}

bool MoveGroupInterface::setOrientationTarget(double x, double y, double z, double w,
                                              const std::string& end_effector_link) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = impl_->pose_frame;
  pose.pose.orientation.x = x;
  pose.pose.orientation.y = y;
  pose.pose.orientation.z = z;
  pose.pose.orientation.w = w;
  impl_->target = Implementation::Target::ORIENTATION;
  return impl_->setPoses(end_effector_link, {pose});
}

bool MoveGroupInterface::setPoseTarget(const Eigen::Isometry3d& end_effector_pose,
                                       const std::string& end_effector_link) {
  return setPoseTargets(std::vector<geometry_msgs::Pose>{message(end_effector_pose)}, end_effector_link);
}
bool MoveGroupInterface::setPoseTarget(const geometry_msgs::Pose& target, const std::string& end_effector_link) {
  return setPoseTargets(std::vector<geometry_msgs::Pose>{target}, end_effector_link);
}
bool MoveGroupInterface::setPoseTarget(const geometry_msgs::PoseStamped& target, const std::string& end_effector_link) {
  return setPoseTargets(std::vector<geometry_msgs::PoseStamped>{target}, end_effector_link);
}
bool MoveGroupInterface::setPoseTargets(const std::vector<geometry_msgs::Pose>& target,
                                        const std::string& end_effector_link) {
  std::vector<geometry_msgs::PoseStamped> poses(target.size());
  for (std::size_t i = 0; i < target.size(); ++i) {
    poses[i].header.frame_id = impl_->pose_frame;
    poses[i].pose = target[i];
  }
  return setPoseTargets(poses, end_effector_link);
}
bool MoveGroupInterface::setPoseTargets(const std::vector<geometry_msgs::PoseStamped>& target,
                                        const std::string& end_effector_link) {
  impl_->target = Implementation::Target::POSES;
  return impl_->setPoses(end_effector_link, target);
}

void MoveGroupInterface::setPoseReferenceFrame(const std::string& pose_reference_frame) {
  impl_->pose_frame = pose_reference_frame;
}
const std::string& MoveGroupInterface::getPoseReferenceFrame() const { return impl_->pose_frame; }

bool MoveGroupInterface::setEndEffectorLink(const std::string& end_effector_link) {
  if (getRobotModel()->getLinkModel(end_effector_link) == nullptr) return false;
  impl_->end_effector_link = end_effector_link;
  return true;
}
bool MoveGroupInterface::setEndEffector(const std::string& eef_name) {
  const moveit::core::JointModelGroup* end_effector = getRobotModel()->getEndEffector(eef_name);
  return end_effector != nullptr && setEndEffectorLink(end_effector->getEndEffectorParentGroup().second);
}
const std::string& MoveGroupInterface::getEndEffectorLink() const { return impl_->end_effector_link; }
const std::string& MoveGroupInterface::getEndEffector() const {
  static const std::string kNone;
  for (const moveit::core::JointModelGroup* group : getRobotModel()->getEndEffectors())
    if (group->getEndEffectorParentGroup().second == impl_->end_effector_link) return group->getEndEffectorName();
  return kNone;
}

void MoveGroupInterface::clearPoseTarget(const std::string& end_effector_link) {
  impl_->pose_targets.erase(impl_->link(end_effector_link));
}
void MoveGroupInterface::clearPoseTargets() { impl_->pose_targets.clear(); }
const geometry_msgs::PoseStamped& MoveGroupInterface::getPoseTarget(const std::string& end_effector_link) const {
  static const geometry_msgs::PoseStamped kNone;
  const std::vector<geometry_msgs::PoseStamped>& poses = getPoseTargets(end_effector_link);
  return poses.empty() ? kNone : poses.front();
}
const std::vector<geometry_msgs::PoseStamped>& MoveGroupInterface::getPoseTargets(
    const std::string& end_effector_link) const {
  static const std::vector<geometry_msgs::PoseStamped> kNone;
  const auto found = impl_->pose_targets.find(impl_->link(end_effector_link));
  return found == impl_->pose_targets.end() ? kNone : found->second;
}

bool MoveGroupInterface::startStateMonitor(double wait) { return impl_->currentState(wait) != nullptr; }
moveit::core::RobotStatePtr MoveGroupInterface::getCurrentState(double wait) const { return impl_->currentState(wait); }
std::vector<double> MoveGroupInterface::getCurrentJointValues() const {
  std::vector<double> result;
  const moveit::core::RobotStatePtr state = impl_->currentState(1.0);
  if (state) state->copyJointGroupPositions(&impl_->group(), result);
  return result;
}
geometry_msgs::PoseStamped MoveGroupInterface::getCurrentPose(const std::string& end_effector_link) const {
  const moveit::core::RobotStatePtr state = impl_->currentState(1.0);
  return impl_->poseOf(state ? *state : moveit::core::RobotState(getRobotModel()), end_effector_link);
}
std::vector<double> MoveGroupInterface::getCurrentRPY(const std::string& end_effector_link) const {
  const Eigen::Matrix3d m = isometry(getCurrentPose(end_effector_link).pose).linear();
  return {std::atan2(m(2, 1), m(2, 2)), std::atan2(-m(2, 0), std::hypot(m(2, 1), m(2, 2))),
          std::atan2(m(1, 0), m(0, 0))};
}
std::vector<double> MoveGroupInterface::getRandomJointValues() const {
  moveit::core::RobotState state(getRobotModel());
  state.setToRandomPositions(&impl_->group());
  std::vector<double> result;
  state.copyJointGroupPositions(&impl_->group(), result);
  return result;
}
geometry_msgs::PoseStamped MoveGroupInterface::getRandomPose(const std::string& end_effector_link) const {
  const moveit::core::RobotStatePtr current = impl_->currentState(1.0);
  moveit::core::RobotState state = current ? *current : moveit::core::RobotState(getRobotModel());
  state.setToRandomPositions(&impl_->group());
  return impl_->poseOf(state, end_effector_link);
}
void MoveGroupInterface::rememberJointValues(const std::string& name) {
  rememberJointValues(name, getCurrentJointValues());
}
void MoveGroupInterface::rememberJointValues(const std::string& name, const std::vector<double>& values) {
  impl_->remembered[name] = values;
}
const std::map<std::string, std::vector<double>>& MoveGroupInterface::getRememberedJointValues() const {
  return impl_->remembered;
}
void MoveGroupInterface::forgetJointValues(const std::string& name) { impl_->remembered.erase(name); }

void MoveGroupInterface::setPathConstraints(const moveit_msgs::Constraints& constraint) {
  impl_->path_constraints = constraint;
}
moveit_msgs::Constraints MoveGroupInterface::getPathConstraints() const { return impl_->path_constraints; }
void MoveGroupInterface::clearPathConstraints() { impl_->path_constraints = moveit_msgs::Constraints(); }

}  // namespace planning_interface
}  // namespace moveit
