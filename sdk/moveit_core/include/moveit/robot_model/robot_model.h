#pragma once

#include <srdfdom/model.h>
#include <urdf/model.h>

#include <deque>
#include <iostream>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "moveit/macros/class_forward.h"
#include "moveit/robot_model/joint_model_group.h"

namespace moveit {

struct Exception : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

namespace core {

MOVEIT_CLASS_FORWARD(RobotModel)

/** Links, joints and groups of a robot; immutable, and shared by its states. */
class RobotModel {
 public:
  RobotModel(const urdf::ModelInterfaceSharedPtr& urdf_model, const srdf::ModelConstSharedPtr& srdf_model);
  RobotModel(const RobotModel&) = delete;
  RobotModel& operator=(const RobotModel&) = delete;

  const std::string& getName() const { return name_; }
  /** Parent frame of the virtual joint, or the root link if there is none or it is fixed. */
  const std::string& getModelFrame() const { return model_frame_; }
  bool isEmpty() const { return links_.empty(); }
  const urdf::ModelInterfaceSharedPtr& getURDF() const { return urdf_; }
  const srdf::ModelConstSharedPtr& getSRDF() const { return srdf_; }

  const JointModel* getRootJoint() const { return joint_models_.front(); }
  const std::string& getRootJointName() const { return getRootJoint()->getName(); }
  const LinkModel* getRootLink() const { return link_models_.front(); }
  const std::string& getRootLinkName() const { return getRootLink()->getName(); }

  /** All joints, parents first. */
  const std::vector<const JointModel*>& getJointModels() const { return joint_models_; }
  const std::vector<std::string>& getJointModelNames() const { return joint_names_; }
  const std::vector<const JointModel*>& getActiveJointModels() const { return active_joints_; }
  bool hasJointModel(const std::string& name) const { return joints_by_name_.count(name) > 0; }
  /** Null, with an error, for an unknown joint. */
  const JointModel* getJointModel(const std::string& joint) const;
  JointModel* getJointModel(const std::string& joint);

  const std::vector<const LinkModel*>& getLinkModels() const { return link_models_; }
  const std::vector<std::string>& getLinkModelNames() const { return link_names_; }
  bool hasLinkModel(const std::string& name) const { return links_by_name_.count(name) > 0; }
  /** Null for an unknown link; `has_link` becomes whether it exists, and without it an error is logged. */
  const LinkModel* getLinkModel(const std::string& link, bool* has_link = nullptr) const;

  bool hasJointModelGroup(const std::string& group) const { return groups_.count(group) > 0; }
  /** Null, with an error, for an unknown group. */
  const JointModelGroup* getJointModelGroup(const std::string& group) const;
  const std::vector<const JointModelGroup*>& getJointModelGroups() const { return group_models_; }
  const std::vector<std::string>& getJointModelGroupNames() const { return group_names_; }
  const std::vector<const JointModelGroup*>& getEndEffectors() const { return end_effectors_; }
  bool hasEndEffector(const std::string& name) const { return getEndEffector(name) != nullptr; }
  const JointModelGroup* getEndEffector(const std::string& name) const;

  const std::vector<std::string>& getVariableNames() const { return variables_; }
  std::size_t getVariableCount() const { return variables_.size(); }
  /** Index of a variable in a state; raises moveit::Exception for an unknown one. */
  std::size_t getVariableIndex(const std::string& variable) const;
  const VariableBounds& getVariableBounds(const std::string& variable) const;
  /** 0 where the limits allow it, otherwise the middle between them. */
  void getVariableDefaultPositions(std::vector<double>& values) const;
  void printModelInfo(std::ostream& out) const;

 private:
  friend class JointModelGroup;

  void addLink(const urdf::LinkConstSharedPtr& link, const JointModel* parent_joint, const LinkModel* parent);
  JointModel& addJoint(const std::string& name, JointModel::JointType type);
  JointModel& addRootJoint();
  void readJoint(const urdf::Joint& from, JointModel& joint);
  void linkMimicJoints();
  void addGroup(const srdf::Model::Group& group);
  void addEndEffectors();
  void addDefaultStates();
  void addChain(const std::string& base, const std::string& tip, std::vector<const JointModel*>& joints) const;

  std::string name_, model_frame_;
  urdf::ModelInterfaceSharedPtr urdf_;
  srdf::ModelConstSharedPtr srdf_;
  std::deque<JointModel> joints_;
  std::deque<LinkModel> links_;
  std::map<std::string, JointModelGroup> groups_;
  std::map<std::string, JointModel*> joints_by_name_;
  std::map<std::string, LinkModel*> links_by_name_;
  std::vector<const JointModel*> joint_models_, active_joints_;
  std::vector<const LinkModel*> link_models_;
  std::vector<const JointModelGroup*> group_models_, end_effectors_;
  std::vector<std::string> joint_names_, link_names_, group_names_, variables_;
  std::map<std::string, std::size_t> variable_indices_;
};

}  // namespace core
}  // namespace moveit

namespace robot_model = moveit::core;
