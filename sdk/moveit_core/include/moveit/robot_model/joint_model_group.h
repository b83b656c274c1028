#pragma once

#include <srdfdom/model.h>

#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "moveit/robot_model/joint_model.h"
#include "moveit/robot_model/link_model.h"

namespace moveit {
namespace core {

class RobotModel;

/** Joints and links that are planned for together. */
class JointModelGroup {
 public:
  const std::string& getName() const { return name_; }
  const RobotModel& getParentModel() const { return *model_; }
  const srdf::Model::Group& getConfig() const { return config_; }

  const std::vector<const JointModel*>& getJointModels() const { return joints_; }
  const std::vector<std::string>& getJointModelNames() const { return joint_names_; }
  /** Joints that move, neither fixed, mimic nor passive. */
  const std::vector<const JointModel*>& getActiveJointModels() const { return active_joints_; }
  const std::vector<std::string>& getActiveJointModelNames() const { return active_joint_names_; }
  const std::vector<const JointModel*>& getFixedJointModels() const { return fixed_joints_; }
  const std::vector<const JointModel*>& getMimicJointModels() const { return mimic_joints_; }
  /** Null, with an error, for a joint that the group lacks. */
  const JointModel* getJointModel(const std::string& joint) const;
  bool hasJointModel(const std::string& joint) const;

  const std::vector<const LinkModel*>& getLinkModels() const { return links_; }
  const std::vector<std::string>& getLinkModelNames() const { return link_names_; }
  const std::vector<std::string>& getLinkModelNamesWithCollisionGeometry() const { return colliding_link_names_; }
  const LinkModel* getLinkModel(const std::string& link) const;
  bool hasLinkModel(const std::string& link) const;

  /** Those of the joints, mimic joints included. */
  const std::vector<std::string>& getVariableNames() const { return variables_; }
  unsigned int getVariableCount() const { return static_cast<unsigned int>(variables_.size()); }
  /** Index of each of the group's variables in the robot's state. */
  const std::vector<int>& getVariableIndexList() const { return variable_indices_; }
  /** Index of a variable, or of a joint's first, in the group; raises moveit::Exception for an unknown one. */
  int getVariableGroupIndex(const std::string& variable) const;
  const JointBoundsVector& getActiveJointModelsBounds() const { return active_bounds_; }

  bool isChain() const { return is_chain_; }
  bool isSingleDOFJoints() const;
  bool isSubgroup(const std::string& group) const;
  const std::vector<std::string>& getSubgroupNames() const { return subgroups_; }

  bool isEndEffector() const { return !end_effector_name_.empty(); }
  const std::string& getEndEffectorName() const { return end_effector_name_; }
  /** Group and link that the end effector, which this group is, is attached to. */
  const std::pair<std::string, std::string>& getEndEffectorParentGroup() const { return end_effector_parent_; }
  const std::vector<std::string>& getAttachedEndEffectorNames() const { return attached_end_effectors_; }
  /** Links at the ends that poses are given for; false if there is none. */
  bool getEndEffectorTips(std::vector<std::string>& tips) const;
  bool getEndEffectorTips(std::vector<const LinkModel*>& tips) const;
  /** Null, with an error, unless there is exactly one. */
  const LinkModel* getOnlyOneEndEffectorTip() const;

  const std::vector<std::string>& getDefaultStateNames() const { return default_state_names_; }
  bool getVariableDefaultPositions(const std::string& name, std::map<std::string, double>& values) const;
  void printGroupInfo(std::ostream& out = std::cout) const;

 private:
  friend class RobotModel;

  std::string name_, end_effector_name_;
  const RobotModel* model_ = nullptr;
  srdf::Model::Group config_;
  std::vector<const JointModel*> joints_, active_joints_, fixed_joints_, mimic_joints_;
  std::vector<std::string> joint_names_, active_joint_names_;
  std::vector<const LinkModel*> links_;
  std::vector<std::string> link_names_, colliding_link_names_, variables_, subgroups_, attached_end_effectors_;
  std::vector<int> variable_indices_;
  JointBoundsVector active_bounds_;
  bool is_chain_ = false;
  std::pair<std::string, std::string> end_effector_parent_;
  std::vector<std::string> default_state_names_;
  std::map<std::string, std::map<std::string, double>> default_states_;
};

}  // namespace core
}  // namespace moveit
