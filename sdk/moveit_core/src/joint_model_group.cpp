#include "moveit/robot_model/joint_model_group.h"

#include <ros/console.h>

#include <algorithm>

#include "moveit/robot_model/robot_model.h"

namespace moveit {
namespace core {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

bool JointModelGroup::hasJointModel(const std::string& joint) const { return contains(joint_names_, joint); }
bool JointModelGroup::hasLinkModel(const std::string& link) const { return contains(link_names_, link); }
bool JointModelGroup::isSubgroup(const std::string& group) const { return contains(subgroups_, group); }

const JointModel* JointModelGroup::getJointModel(const std::string& joint) const {
  if (hasJointModel(joint)) return model_->getJointModel(joint);
  ROS_ERROR_NAMED("robot_model", "Joint '%s' not found in group '%s'", joint.c_str(), name_.c_str());
  return nullptr;
}

const LinkModel* JointModelGroup::getLinkModel(const std::string& link) const {
  if (hasLinkModel(link)) return model_->getLinkModel(link);
  ROS_ERROR_NAMED("robot_model", "Link '%s' not found in group '%s'", link.c_str(), name_.c_str());
  return nullptr;
}

int JointModelGroup::getVariableGroupIndex(const std::string& variable) const {
  auto found = std::find(variables_.begin(), variables_.end(), variable);
  if (found == variables_.end() && hasJointModel(variable)) {
    const JointModel* joint = model_->getJointModel(variable);
    if (joint->getVariableCount() > 0)
      found = std::find(variables_.begin(), variables_.end(), joint->getVariableNames()[0]);
  }
  if (found == variables_.end()) throw Exception("Variable '" + variable + "' is not part of group '" + name_ + "'");
  return static_cast<int>(found - variables_.begin());
}

bool JointModelGroup::isSingleDOFJoints() const {
  return std::all_of(active_joints_.begin(), active_joints_.end(),
                     [](const JointModel* joint) { return joint->getVariableCount() == 1; });
}

bool JointModelGroup::getEndEffectorTips(std::vector<const LinkModel*>& tips) const {
  tips.clear();
  for (const std::string& name : attached_end_effectors_) {
    const JointModelGroup* end_effector = model_->getEndEffector(name);
    const LinkModel* link = model_->getLinkModel(end_effector->getEndEffectorParentGroup().second);
    if (link != nullptr && std::find(tips.begin(), tips.end(), link) == tips.end()) tips.push_back(link);
  }
  if (tips.empty() && is_chain_ && !links_.empty()) tips.push_back(links_.back());
  return !tips.empty();
}

bool JointModelGroup::getEndEffectorTips(std::vector<std::string>& tips) const {
  std::vector<const LinkModel*> links;
  getEndEffectorTips(links);
  tips.clear();
  for (const LinkModel* link : links) tips.push_back(link->getName());
  return !tips.empty();
}

const LinkModel* JointModelGroup::getOnlyOneEndEffectorTip() const {
  std::vector<const LinkModel*> tips;
  getEndEffectorTips(tips);
  if (tips.size() == 1) return tips.front();
  ROS_ERROR_NAMED("robot_model", "%s end effectors found for joint model group '%s'",
                  tips.empty() ? "No" : "More than one", name_.c_str());
  return nullptr;
}

bool JointModelGroup::getVariableDefaultPositions(const std::string& name,
                                                  std::map<std::string, double>& values) const {
  const auto found = default_states_.find(name);
  if (found == default_states_.end()) return false;
  values = found->second;
  return true;
}

void JointModelGroup::printGroupInfo(std::ostream& out) const {
  out << "Group '" << name_ << "' using " << variables_.size() << " variables\n  * Joints:\n";
  for (const JointModel* joint : joints_) out << "    '" << joint->getName() << "' (" << joint->getTypeName() << ")\n";
  out << "  * Variables:\n";
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    out << "    '" << variables_[i] << "', index " << variable_indices_[i] << " in full state, index " << i
        << " in group state\n        " << model_->getVariableBounds(variables_[i]) << '\n';
  }
}

}  // namespace core
}  // namespace moveit
