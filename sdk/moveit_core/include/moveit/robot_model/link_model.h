#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace moveit {
namespace core {

class JointModel;
class RobotModel;

/** Link of a robot. */
class LinkModel {
 public:
  const std::string& getName() const { return name_; }
  int getLinkIndex() const { return index_; }
  const JointModel* getParentJointModel() const { return parent_joint_; }
  /** Null for the root link. */
  const LinkModel* getParentLinkModel() const { return parent_; }
  const std::vector<const JointModel*>& getChildJointModels() const { return child_joints_; }
  /** Pose of the parent joint's frame in the parent link. */
  const Eigen::Isometry3d& getJointOriginTransform() const { return joint_origin_; }
  bool hasCollisionGeometry() const { return has_collision_geometry_; }
  /** Empty if the link's first visual is no mesh. */
  const std::string& getVisualMeshFilename() const { return visual_mesh_; }

 private:
  friend class RobotModel;

  std::string name_, visual_mesh_;
  int index_ = 0;
  bool has_collision_geometry_ = false;
  const JointModel* parent_joint_ = nullptr;
  const LinkModel* parent_ = nullptr;
  std::vector<const JointModel*> child_joints_;
  Eigen::Isometry3d joint_origin_ = Eigen::Isometry3d::Identity();
};

}  // namespace core
}  // namespace moveit
