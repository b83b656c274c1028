#pragma once

#include <urdf/model.h>

#include <kdl/tree.hpp>
#include <string>

namespace kdl_parser {
namespace impl {

inline KDL::Vector toKdl(const urdf::Vector3& v) { return KDL::Vector(v.x, v.y, v.z); }
inline KDL::Frame toKdl(const urdf::Pose& p) {
  return KDL::Frame(KDL::Rotation::Quaternion(p.rotation.x, p.rotation.y, p.rotation.z, p.rotation.w),
                    toKdl(p.position));
}
inline KDL::Joint toKdl(const urdf::Joint& joint) {
  const KDL::Frame parent = toKdl(joint.parent_to_joint_origin_transform);
  const KDL::Vector axis = parent.M * toKdl(joint.axis);
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS: return KDL::Joint(joint.name, parent.p, axis, KDL::Joint::RotAxis);
    case urdf::Joint::PRISMATIC: return KDL::Joint(joint.name, parent.p, axis, KDL::Joint::TransAxis);
    default: return KDL::Joint(joint.name, KDL::Joint::None);  // planar and floating joints are fixed, as KDL has none
  }
}
inline KDL::RigidBodyInertia toKdl(const urdf::Inertial& inertial) {
  const KDL::Frame frame = toKdl(inertial.origin);
  const KDL::RotationalInertia about_com(inertial.ixx, inertial.iyy, inertial.izz, inertial.ixy, inertial.ixz,
                                         inertial.iyz);
  // In the axes of the link: R I Rᵀ, whose lever to the center of mass follows in RigidBodyInertia.
  const KDL::RigidBodyInertia turned = frame.M * KDL::RigidBodyInertia(inertial.mass, KDL::Vector::Zero(), about_com);
  return KDL::RigidBodyInertia(inertial.mass, frame.p, turned.getRotationalInertia());
}
inline bool addChildren(const urdf::Link& link, KDL::Tree& tree) {
  for (const urdf::LinkSharedPtr& child : link.child_links) {
    const KDL::RigidBodyInertia inertia = child->inertial ? toKdl(*child->inertial) : KDL::RigidBodyInertia(0);
    const urdf::Joint& joint = *child->parent_joint;
    const KDL::Segment segment(child->name, toKdl(joint), toKdl(joint.parent_to_joint_origin_transform), inertia);
    if (!tree.addSegment(segment, link.name) || !addChildren(*child, tree)) return false;
  }
  return true;
}

}  // namespace impl

/** Tree of a robot's joints and links; its root is the robot's root link, whose inertia KDL does not keep. */
inline bool treeFromUrdfModel(const urdf::ModelInterface& robot_model, KDL::Tree& tree) {
  const urdf::LinkConstSharedPtr root = robot_model.getRoot();
  if (!root) return false;
  tree = KDL::Tree(root->name);
  return impl::addChildren(*root, tree);
}
inline bool treeFromString(const std::string& xml, KDL::Tree& tree) {
  urdf::Model model;
  return model.initString(xml) && treeFromUrdfModel(model, tree);
}
inline bool treeFromFile(const std::string& file, KDL::Tree& tree) {
  urdf::Model model;
  return model.initFile(file) && treeFromUrdfModel(model, tree);
}
/** Tree of the robot in a parameter, such as robot_description. */
inline bool treeFromParam(const std::string& param, KDL::Tree& tree) {
  urdf::Model model;
  return model.initParam(param) && treeFromUrdfModel(model, tree);
}

}  // namespace kdl_parser
