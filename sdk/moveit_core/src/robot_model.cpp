#include "moveit/robot_model/robot_model.h"

#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace moveit {
namespace core {
namespace {

Eigen::Isometry3d isometry(const urdf::Pose& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() =
      Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z).toRotationMatrix();
  result.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return result;
}

JointModel::JointType typeNamed(const std::string& name) {
  if (name == "planar") return JointModel::PLANAR;
  if (name == "floating") return JointModel::FLOATING;
  return JointModel::FIXED;
}

std::vector<std::string> variablesOf(const std::string& joint, JointModel::JointType type) {
  switch (type) {
    case JointModel::REVOLUTE:
    case JointModel::PRISMATIC: return {joint};
    case JointModel::PLANAR: return {joint + "/x", joint + "/y", joint + "/theta"};
    case JointModel::FLOATING:
      return {joint + "/trans_x", joint + "/trans_y", joint + "/trans_z", joint + "/rot_x",
              joint + "/rot_y",   joint + "/rot_z",   joint + "/rot_w"};
    default: return {};
  }
}

void limitVelocity(VariableBounds& bounds, double velocity) {
  bounds.velocity_bounded_ = velocity > 0.0;
  bounds.min_velocity_ = -velocity;
  bounds.max_velocity_ = velocity;
}

}  // namespace

RobotModel::RobotModel(const urdf::ModelInterfaceSharedPtr& urdf_model, const srdf::ModelConstSharedPtr& srdf_model)
    : name_(urdf_model->getName()), urdf_(urdf_model), srdf_(srdf_model) {
  const urdf::LinkConstSharedPtr root = urdf_->getRoot();
  if (!root) {
    ROS_WARN_NAMED("robot_model", "No geometry is associated to any robot links");
    return;
  }
  addLink(root, &addRootJoint(), nullptr);
  linkMimicJoints();
  for (const JointModel& joint : joints_)
    if (joint.getVariableCount() > 0 && joint.mimic_ == nullptr) active_joints_.push_back(&joint);
  for (const srdf::Model::PassiveJoint& passive : srdf_->getPassiveJoints()) {
    const auto found = joints_by_name_.find(passive.name_);
    if (found != joints_by_name_.end()) found->second->is_passive_ = true;
  }
  std::set<std::string> known;
  // A group may stand before those that it contains.
  for (std::size_t round = 0; round <= srdf_->getGroups().size(); ++round) {
    for (const srdf::Model::Group& group : srdf_->getGroups()) {
      const bool is_ready = std::all_of(group.subgroups_.begin(), group.subgroups_.end(),
                                        [&known](const std::string& name) { return known.count(name) > 0; });
      if (!is_ready || !known.insert(group.name_).second) continue;
      addGroup(group);
    }
  }
  for (const srdf::Model::Group& group : srdf_->getGroups()) {
    if (known.count(group.name_) == 0) {
      ROS_ERROR_NAMED("robot_model", "Could not process group '%s': it has subgroups that are unknown or contain it",
                      group.name_.c_str());
    }
  }
  for (const auto& entry : groups_) {
    group_models_.push_back(&entry.second);
    group_names_.push_back(entry.first);
  }
  addEndEffectors();
  addDefaultStates();
}

JointModel& RobotModel::addJoint(const std::string& name, JointModel::JointType type) {
  joints_.emplace_back();
  JointModel& joint = joints_.back();
  joint.name_ = name;
  joint.type_ = type;
  joint.index_ = static_cast<int>(joints_.size()) - 1;
  joint.variables_ = variablesOf(name, type);
  joint.bounds_.resize(joint.variables_.size());
  joint.first_variable_ = variables_.size();
  for (const std::string& variable : joint.variables_) {
    variable_indices_[variable] = variables_.size();
    variables_.push_back(variable);
  }
  joints_by_name_[name] = &joint;
  joint_models_.push_back(&joint);
  joint_names_.push_back(name);
  return joint;
}

JointModel& RobotModel::addRootJoint() {
  model_frame_ = urdf_->getRoot()->name;
  for (const srdf::Model::VirtualJoint& joint : srdf_->getVirtualJoints()) {
    if (joint.child_link_ != urdf_->getRoot()->name) {
      ROS_WARN_NAMED("robot_model",
                     "Skipping virtual joint '%s' because its child frame '%s' does not match the URDF frame '%s'",
                     joint.name_.c_str(), joint.child_link_.c_str(), urdf_->getRoot()->name.c_str());
      continue;
    }
    if (joint.type_ != "fixed") model_frame_ = joint.parent_frame_;  // as move_group, and MoveIt
    return addJoint(joint.name_, typeNamed(joint.type_));
  }
  return addJoint("ASSUMED_FIXED_ROOT_JOINT", JointModel::FIXED);
}

void RobotModel::addLink(const urdf::LinkConstSharedPtr& link, const JointModel* parent_joint,
                         const LinkModel* parent) {
  links_.emplace_back();
  LinkModel& model = links_.back();
  model.name_ = link->name;
  model.index_ = static_cast<int>(links_.size()) - 1;
  model.parent_joint_ = parent_joint;
  model.parent_ = parent;
  model.joint_origin_ = parent_joint->origin_;
  model.has_collision_geometry_ = !link->collision_array.empty();
  if (link->visual && link->visual->geometry && link->visual->geometry->type == urdf::Geometry::MESH)
    model.visual_mesh_ = static_cast<const urdf::Mesh&>(*link->visual->geometry).filename;
  links_by_name_[model.name_] = &model;
  link_models_.push_back(&model);
  link_names_.push_back(model.name_);
  joints_by_name_[parent_joint->getName()]->child_ = &model;
  for (const urdf::JointSharedPtr& child : link->child_joints) {
    JointModel::JointType type = JointModel::FIXED;
    if (child->type == urdf::Joint::REVOLUTE || child->type == urdf::Joint::CONTINUOUS) type = JointModel::REVOLUTE;
    if (child->type == urdf::Joint::PRISMATIC) type = JointModel::PRISMATIC;
    if (child->type == urdf::Joint::PLANAR) type = JointModel::PLANAR;
    if (child->type == urdf::Joint::FLOATING) type = JointModel::FLOATING;
    JointModel& joint = addJoint(child->name, type);
    readJoint(*child, joint);
    joint.parent_ = &model;
    model.child_joints_.push_back(&joint);
    addLink(urdf_->getLink(child->child_link_name), &joint, &model);
  }
}

void RobotModel::readJoint(const urdf::Joint& from, JointModel& joint) {
  joint.origin_ = isometry(from.parent_to_joint_origin_transform);
  joint.is_continuous_ = from.type == urdf::Joint::CONTINUOUS;
  const Eigen::Vector3d axis(from.axis.x, from.axis.y, from.axis.z);
  joint.axis_ = axis.norm() > 0.0 ? Eigen::Vector3d(axis.normalized()) : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  if (joint.bounds_.size() != 1) return;
  VariableBounds& bounds = joint.bounds_[0];
  if (joint.is_continuous_) {
    bounds.min_position_ = -M_PI;
    bounds.max_position_ = M_PI;
  } else if (from.limits) {
    bounds.position_bounded_ = true;
    bounds.min_position_ = from.limits->lower;
    bounds.max_position_ = from.limits->upper;
    if (from.safety && from.safety->soft_upper_limit > from.safety->soft_lower_limit) {
      bounds.min_position_ = std::max(bounds.min_position_, from.safety->soft_lower_limit);
      bounds.max_position_ = std::min(bounds.max_position_, from.safety->soft_upper_limit);
    }
  }
  if (from.limits) limitVelocity(bounds, std::abs(from.limits->velocity));
}

void RobotModel::linkMimicJoints() {
  for (const auto& entry : urdf_->joints_) {
    if (!entry.second->mimic) continue;
    const auto self = joints_by_name_.find(entry.first), master = joints_by_name_.find(entry.second->mimic->joint_name);
    if (self == joints_by_name_.end()) continue;
    if (master == joints_by_name_.end() || master == self ||
        master->second->getVariableCount() != self->second->getVariableCount()) {
      ROS_ERROR_NAMED("robot_model", "Joint '%s' cannot mimic joint '%s'", entry.first.c_str(),
                      entry.second->mimic->joint_name.c_str());
      continue;
    }
    self->second->mimic_ = master->second;
    self->second->mimic_factor_ = entry.second->mimic->multiplier;
    self->second->mimic_offset_ = entry.second->mimic->offset;
  }
  for (JointModel& joint : joints_) {  // a joint may mimic one that mimics
    for (std::size_t step = 0; joint.mimic_ != nullptr && joint.mimic_->mimic_ != nullptr; ++step) {
      if (step > joints_.size()) {
        ROS_ERROR_NAMED("robot_model", "Cycle found in joint that mimic each other. Ignoring all mimic joints.");
        for (JointModel& other : joints_) other.mimic_ = nullptr;
        return;
      }
      joint.mimic_offset_ += joint.mimic_factor_ * joint.mimic_->mimic_offset_;
      joint.mimic_factor_ *= joint.mimic_->mimic_factor_;
      joint.mimic_ = joint.mimic_->mimic_;
    }
  }
}

void RobotModel::addChain(const std::string& base, const std::string& tip,
                          std::vector<const JointModel*>& joints) const {
  std::vector<const JointModel*> chain;
  const LinkModel* link = links_by_name_.at(tip);
  while (link != nullptr && link->getName() != base) {
    chain.push_back(link->getParentJointModel());
    link = link->getParentLinkModel();
  }
  if (link == nullptr) {
    ROS_ERROR_NAMED("robot_model", "No chain of joints leads from link '%s' to link '%s'", base.c_str(), tip.c_str());
    return;
  }
  joints.insert(joints.end(), chain.rbegin(), chain.rend());
}

void RobotModel::addGroup(const srdf::Model::Group& group) {
  std::vector<const JointModel*> members;
  for (const auto& chain : group.chains_) addChain(chain.first, chain.second, members);
  for (const std::string& name : group.joints_) members.push_back(joints_by_name_.at(name));
  for (const std::string& name : group.links_) members.push_back(links_by_name_.at(name)->getParentJointModel());
  for (const std::string& name : group.subgroups_) {
    const JointModelGroup& subgroup = groups_.at(name);
    members.insert(members.end(), subgroup.joints_.begin(), subgroup.joints_.end());
  }
  if (members.empty()) {
    ROS_WARN_NAMED("robot_model", "Group '%s' must have at least one valid joint", group.name_.c_str());
    return;
  }
  std::sort(members.begin(), members.end(), [](const JointModel* one, const JointModel* other) {
    return one->getJointIndex() < other->getJointIndex();
  });
  members.erase(std::unique(members.begin(), members.end()), members.end());

  JointModelGroup& model = groups_[group.name_];
  model.name_ = group.name_;
  model.model_ = this;
  model.config_ = group;
  model.subgroups_ = group.subgroups_;
  model.is_chain_ = true;
  for (const JointModel* joint : members) {
    if (!model.joints_.empty() && joint->getParentLinkModel() != model.joints_.back()->getChildLinkModel())
      model.is_chain_ = false;
    model.joints_.push_back(joint);
    model.joint_names_.push_back(joint->getName());
    if (joint->getVariableCount() == 0) {
      model.fixed_joints_.push_back(joint);
    } else if (joint->getMimic() != nullptr) {
      model.mimic_joints_.push_back(joint);
    } else if (!joint->isPassive()) {
      model.active_joints_.push_back(joint);
      model.active_joint_names_.push_back(joint->getName());
      model.active_bounds_.push_back(&joint->getVariableBounds());
    }
    for (const std::string& variable : joint->getVariableNames()) {
      model.variable_indices_.push_back(static_cast<int>(variable_indices_.at(variable)));
      model.variables_.push_back(variable);
    }
    const LinkModel* link = joint->getChildLinkModel();
    model.links_.push_back(link);
    model.link_names_.push_back(link->getName());
    if (link->hasCollisionGeometry()) model.colliding_link_names_.push_back(link->getName());
  }
}

void RobotModel::addEndEffectors() {
  for (const srdf::Model::EndEffector& end_effector : srdf_->getEndEffectors()) {
    const auto component = groups_.find(end_effector.component_group_);
    if (component == groups_.end()) {
      ROS_ERROR_NAMED("robot_model", "End effector '%s': there is no group '%s'", end_effector.name_.c_str(),
                      end_effector.component_group_.c_str());
      continue;
    }
    std::string parent = end_effector.parent_group_;
    if (groups_.count(parent) == 0) {
      parent.clear();
      std::size_t fewest = 0;  // joints of the smallest group with the parent link
      for (const auto& entry : groups_) {
        const std::size_t count = entry.second.joints_.size();
        if (entry.first == component->first || !entry.second.hasLinkModel(end_effector.parent_link_)) continue;
        if (!parent.empty() && count >= fewest) continue;
        parent = entry.first;
        fewest = count;
      }
    }
    component->second.end_effector_name_ = end_effector.name_;
    component->second.end_effector_parent_ = {parent, end_effector.parent_link_};
    if (!parent.empty()) groups_.at(parent).attached_end_effectors_.push_back(end_effector.name_);
    end_effectors_.push_back(&component->second);
  }
}

void RobotModel::addDefaultStates() {
  for (const srdf::Model::GroupState& state : srdf_->getGroupStates()) {
    const auto group = groups_.find(state.group_);
    if (group == groups_.end()) {
      ROS_ERROR_NAMED("robot_model", "Group state '%s' specified for group '%s', but that group does not exist",
                      state.name_.c_str(), state.group_.c_str());
      continue;
    }
    std::map<std::string, double> values;
    for (const auto& entry : state.joint_values_) {
      const auto joint = joints_by_name_.find(entry.first);
      if (joint == joints_by_name_.end() || joint->second->getVariableCount() != entry.second.size()) {
        ROS_ERROR_NAMED("robot_model", "Group state '%s': joint '%s' does not have %zu values", state.name_.c_str(),
                        entry.first.c_str(), entry.second.size());
        continue;
      }
      for (std::size_t i = 0; i < entry.second.size(); ++i) values[joint->second->variables_[i]] = entry.second[i];
    }
    group->second.default_state_names_.push_back(state.name_);
    group->second.default_states_[state.name_] = values;
  }
}

const JointModel* RobotModel::getJointModel(const std::string& joint) const {
  const auto found = joints_by_name_.find(joint);
  if (found != joints_by_name_.end()) return found->second;
  ROS_ERROR_NAMED("robot_model", "Joint '%s' not found in model '%s'", joint.c_str(), name_.c_str());
  return nullptr;
}

JointModel* RobotModel::getJointModel(const std::string& joint) {
  return const_cast<JointModel*>(static_cast<const RobotModel*>(this)->getJointModel(joint));
}

const LinkModel* RobotModel::getLinkModel(const std::string& link, bool* has_link) const {
  const auto found = links_by_name_.find(link);
  if (has_link != nullptr) *has_link = found != links_by_name_.end();
  if (found != links_by_name_.end()) return found->second;
  if (has_link == nullptr)
    ROS_ERROR_NAMED("robot_model", "Link '%s' not found in model '%s'", link.c_str(), name_.c_str());
  return nullptr;
}

const JointModelGroup* RobotModel::getJointModelGroup(const std::string& group) const {
  const auto found = groups_.find(group);
  if (found != groups_.end()) return &found->second;
  ROS_ERROR_NAMED("robot_model", "Group '%s' not found in model '%s'", group.c_str(), name_.c_str());
  return nullptr;
}

const JointModelGroup* RobotModel::getEndEffector(const std::string& name) const {
  for (const JointModelGroup* group : end_effectors_)
    if (group->getEndEffectorName() == name || group->getName() == name) return group;
  return nullptr;
}

std::size_t RobotModel::getVariableIndex(const std::string& variable) const {
  const auto found = variable_indices_.find(variable);
  if (found == variable_indices_.end())
    throw Exception("Variable '" + variable + "' is not known to model '" + name_ + "'");
  return found->second;
}

const VariableBounds& RobotModel::getVariableBounds(const std::string& variable) const {
  const std::size_t index = getVariableIndex(variable);
  const auto joint = std::find_if(joints_.begin(), joints_.end(), [index](const JointModel& candidate) {
    return index >= candidate.first_variable_ && index < candidate.first_variable_ + candidate.getVariableCount();
  });
  return joint->bounds_[index - joint->first_variable_];
}

void RobotModel::getVariableDefaultPositions(std::vector<double>& values) const {
  values.assign(variables_.size(), 0.0);
  for (const JointModel& joint : joints_) {
    for (std::size_t i = 0; i < joint.bounds_.size(); ++i) {
      const VariableBounds& bounds = joint.bounds_[i];
      if (!bounds.position_bounded_ || (bounds.min_position_ <= 0.0 && bounds.max_position_ >= 0.0)) continue;
      values[joint.first_variable_ + i] = 0.5 * (bounds.min_position_ + bounds.max_position_);
    }
    if (joint.type_ == JointModel::FLOATING) values[joint.first_variable_ + 6] = 1.0;
  }
}

void RobotModel::printModelInfo(std::ostream& out) const {
  out << "Model " << name_ << " in frame " << model_frame_ << ", using " << variables_.size() << " variables\n";
  for (const JointModel* joint : joint_models_) {
    out << "  Joint '" << joint->getName() << "' (" << joint->getTypeName() << ")\n";
    for (std::size_t i = 0; i < joint->getVariableCount(); ++i)
      out << "    * " << joint->getVariableNames()[i] << ' ' << joint->getVariableBounds()[i] << '\n';
  }
  for (const JointModelGroup* group : group_models_) group->printGroupInfo(out);
}

}  // namespace core
}  // namespace moveit
