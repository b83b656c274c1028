#pragma once

#include <ros/node_handle.h>
#include <urdf/urdfdom_compatibility.h>
#include <urdf_parser/urdf_parser.h>

#include <string>

namespace urdf_geometry_parser {

/** Distances of joints and radii of wheels, from the parameter robot_description; a line of the log says what lacks. */
class UrdfGeometryParser {
 public:
  /** `base_link`: the frame of distances. */
  UrdfGeometryParser(ros::NodeHandle& root_nh, const std::string& base_link);

  /** Sum of the positions [m] of the joints from a link to a joint; rotations between them are not applied. */
  bool getTransformVector(const std::string& joint_name, const std::string& parent_link_name,
                          urdf::Vector3& transform_vector);
  /** Distance [m] of two joints in the plane of x and y. */
  bool getDistanceBetweenJoints(const std::string& first_joint_name, const std::string& second_joint_name,
                                double& distance);
  /** Radius [m] of a joint's link, whose collision has to be a cylinder. */
  bool getJointRadius(const std::string& joint_name, double& radius);
  /** Limit [rad] of a revolute joint to both sides: the nearer one. */
  bool getJointSteeringLimits(const std::string& joint_name, double& steering_limit);

 private:
  urdf::JointConstSharedPtr joint(const std::string& name) const;

  std::string base_link_;
  urdf::ModelInterfaceSharedPtr model_;
};

}  // namespace urdf_geometry_parser
