#include "urdf_geometry_parser/urdf_geometry_parser.h"

#include <ros/console.h>

#include <algorithm>
#include <cmath>

namespace urdf_geometry_parser {

UrdfGeometryParser::UrdfGeometryParser(ros::NodeHandle& root_nh, const std::string& base_link) : base_link_(base_link) {
  std::string text;
  if (!root_nh.getParam("robot_description", text)) {
    ROS_ERROR("there is no parameter %s", root_nh.resolveName("robot_description").c_str());
    return;
  }
  model_ = urdf::parseURDF(text);
  if (!model_) ROS_ERROR("parameter %s is no URDF", root_nh.resolveName("robot_description").c_str());
}

urdf::JointConstSharedPtr UrdfGeometryParser::joint(const std::string& name) const {
  const urdf::JointConstSharedPtr found = model_ ? model_->getJoint(name) : urdf::JointConstSharedPtr();
  if (!found) ROS_ERROR("robot_description has no joint '%s'", name.c_str());
  return found;
}

bool UrdfGeometryParser::getTransformVector(const std::string& joint_name, const std::string& parent_link_name,
                                            urdf::Vector3& transform_vector) {
  urdf::JointConstSharedPtr at = joint(joint_name);
  urdf::Vector3 sum;
  while (at) {
    sum = sum + at->parent_to_joint_origin_transform.position;
    if (at->parent_link_name == parent_link_name) {
      transform_vector = sum;
      return true;
    }
    const urdf::LinkConstSharedPtr link = model_->getLink(at->parent_link_name);
    at = link ? link->parent_joint : nullptr;
  }
  ROS_ERROR("link '%s' is not above joint '%s'", parent_link_name.c_str(), joint_name.c_str());
  return false;
}

bool UrdfGeometryParser::getDistanceBetweenJoints(const std::string& first_joint_name,
                                                  const std::string& second_joint_name, double& distance) {
  urdf::Vector3 first, second;
  if (!getTransformVector(first_joint_name, base_link_, first)) return false;
  if (!getTransformVector(second_joint_name, base_link_, second)) return false;
  distance = std::hypot(first.x - second.x, first.y - second.y);
  return true;
}

bool UrdfGeometryParser::getJointRadius(const std::string& joint_name, double& radius) {
  const urdf::JointConstSharedPtr found = joint(joint_name);
  if (!found) return false;
  const urdf::LinkConstSharedPtr link = model_->getLink(found->child_link_name);
  const urdf::Geometry* const geometry = link && link->collision ? link->collision->geometry.get() : nullptr;
  if (!geometry || geometry->type != urdf::Geometry::CYLINDER) {
    ROS_ERROR("the collision of link '%s' is no cylinder, whose radius is that of joint '%s'",
              found->child_link_name.c_str(), joint_name.c_str());
    return false;
  }
  radius = static_cast<const urdf::Cylinder*>(geometry)->radius;
  return true;
}

bool UrdfGeometryParser::getJointSteeringLimits(const std::string& joint_name, double& steering_limit) {
  const urdf::JointConstSharedPtr found = joint(joint_name);
  if (!found) return false;
  if (found->type != urdf::Joint::REVOLUTE || !found->limits) {
    ROS_ERROR("joint '%s' is not revolute, and has no limits", joint_name.c_str());
    return false;
  }
  steering_limit = std::min(std::abs(found->limits->lower), std::abs(found->limits->upper));
  return true;
}

}  // namespace urdf_geometry_parser
