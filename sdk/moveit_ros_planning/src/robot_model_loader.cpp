#include "moveit/robot_model_loader/robot_model_loader.h"

#include <ros/console.h>
#include <ros/node_handle.h>

namespace robot_model_loader {
namespace {

/** Text of a parameter of this namespace or of one around it. */
bool readText(const std::string& name, std::string& text) {
  ros::NodeHandle node;
  std::string found;
  if (node.searchParam(name, found) && node.getParam(found, text)) return true;
  ROS_ERROR_NAMED("robot_model_loader", "Robot model parameter '%s' not found; did you remap '%s'?", name.c_str(),
                  name.c_str());
  return false;
}

}  // namespace

void RobotModelLoader::load(const Options& options) {
  robot_description_ = options.robot_description_;
  std::string urdf_text = options.urdf_string_, srdf_text = options.srdf_string_;
  if (urdf_text.empty() &&
      (!readText(robot_description_, urdf_text) || !readText(robot_description_ + "_semantic", srdf_text))) {
    return;
  }
  const auto robot = std::make_shared<urdf::Model>();
  if (!robot->initString(urdf_text)) {
    ROS_ERROR_NAMED("robot_model_loader", "Unable to parse URDF from parameter '%s'", robot_description_.c_str());
    return;
  }
  const auto semantics = std::make_shared<srdf::Model>();
  if (!semantics->initString(*robot, srdf_text)) {
    ROS_ERROR_NAMED("robot_model_loader", "Unable to parse SRDF from parameter '%s_semantic'",
                    robot_description_.c_str());
    return;
  }
  urdf_ = robot;
  srdf_ = semantics;
  model_ = std::make_shared<moveit::core::RobotModel>(urdf_, srdf_);
  if (!robot_description_.empty()) readJointLimits();
  ROS_INFO_NAMED("robot_model", "Loading robot model '%s'...", model_->getName().c_str());
}

void RobotModelLoader::readJointLimits() {
  ros::NodeHandle node(robot_description_ + "_planning");
  const auto limit = [&node](const std::string& prefix, const std::string& kind, double& value) {
    bool is_limited = false;
    const bool is_given = node.getParam(prefix + "has_" + kind + "_limits", is_limited);
    if (node.getParam(prefix + "max_" + kind, value) && !is_given) is_limited = true;
    return is_limited;
  };
  for (const moveit::core::JointModel* joint : model_->getActiveJointModels()) {
    for (const std::string& variable : joint->getVariableNames()) {
      moveit::core::VariableBounds bounds = joint->getVariableBounds(variable);
      const std::string prefix = "joint_limits/" + variable + "/";
      if (limit(prefix, "position", bounds.max_position_)) {
        node.getParam(prefix + "min_position", bounds.min_position_);
        bounds.position_bounded_ = true;
      }
      if (limit(prefix, "velocity", bounds.max_velocity_)) {
        bounds.min_velocity_ = -bounds.max_velocity_;
        bounds.velocity_bounded_ = true;
      }
      if (limit(prefix, "acceleration", bounds.max_acceleration_)) {
        bounds.min_acceleration_ = -bounds.max_acceleration_;
        bounds.acceleration_bounded_ = true;
      }
      model_->getJointModel(joint->getName())->setVariableBounds(variable, bounds);
    }
  }
}

}  // namespace robot_model_loader
