#include "moveit/robot_state/robot_state.h"

#include <algorithm>
#include <cmath>

namespace moveit {
namespace core {
namespace {

std::mt19937& sharedRandom() {
  thread_local std::mt19937 random{std::random_device()()};
  return random;
}

}  // namespace

RobotState::RobotState(const RobotModelConstPtr& robot_model)
    : model_(robot_model),
      velocity_(model_->getVariableCount()),
      acceleration_(model_->getVariableCount()),
      effort_(model_->getVariableCount()),
      transforms_(model_->getLinkModels().size(), Eigen::Isometry3d::Identity()) {
  setToDefaultValues();
}

void RobotState::setPosition(std::size_t index, double value) {
  position_[index] = value;
  updateMimicJoints();
}

void RobotState::updateMimicJoints() {
  is_stale_ = true;
  for (const JointModel* joint : model_->getJointModels()) {
    if (joint->getMimic() == nullptr) continue;
    for (std::size_t i = 0; i < joint->getVariableCount(); ++i) {
      position_[joint->getFirstVariableIndex() + i] =
          joint->getMimicFactor() * position_[joint->getMimic()->getFirstVariableIndex() + i] + joint->getMimicOffset();
    }
  }
}

void RobotState::setVariablePositions(const double* position) {
  position_.assign(position, position + position_.size());
  updateMimicJoints();
}

void RobotState::setVariablePositions(const std::vector<double>& position) {
  if (position.size() != position_.size()) {
    throw Exception("a state of '" + model_->getName() + "' has " + std::to_string(position_.size()) +
                    " positions, not " + std::to_string(position.size()));
  }
  setVariablePositions(position.data());
}

void RobotState::setVariablePositions(const std::map<std::string, double>& variables) {
  for (const auto& entry : variables) position_[index(entry.first)] = entry.second;
  updateMimicJoints();
}

void RobotState::setVariablePositions(const std::vector<std::string>& names, const std::vector<double>& positions) {
  for (std::size_t i = 0; i < std::min(names.size(), positions.size()); ++i) position_[index(names[i])] = positions[i];
  updateMimicJoints();
}

void RobotState::setVariableValues(const sensor_msgs::JointState& values) {
  setVariablePositions(values.name, values.position);
  if (values.velocity.size() == values.name.size())
    for (std::size_t i = 0; i < values.name.size(); ++i) setVariableVelocity(values.name[i], values.velocity[i]);
  if (values.effort.size() == values.name.size())
    for (std::size_t i = 0; i < values.name.size(); ++i) setVariableEffort(values.name[i], values.effort[i]);
}

void RobotState::setVariableVelocities(const std::vector<double>& velocity) {
  has_velocity_ = true;
  std::copy_n(velocity.begin(), std::min(velocity.size(), velocity_.size()), velocity_.begin());
}

void RobotState::setJointPositions(const JointModel* joint, const double* position) {
  std::copy_n(position, joint->getVariableCount(), position_.data() + joint->getFirstVariableIndex());
  updateMimicJoints();
}

void RobotState::setJointGroupPositions(const JointModelGroup* group, const double* values) {
  const std::vector<int>& indices = group->getVariableIndexList();
  for (std::size_t i = 0; i < indices.size(); ++i) position_[static_cast<std::size_t>(indices[i])] = values[i];
  updateMimicJoints();
}

void RobotState::setJointGroupActivePositions(const JointModelGroup* group, const std::vector<double>& values) {
  std::size_t next = 0;
  for (const JointModel* joint : group->getActiveJointModels())
    for (std::size_t i = 0; i < joint->getVariableCount() && next < values.size(); ++i, ++next)
      position_[joint->getFirstVariableIndex() + i] = values[next];
  updateMimicJoints();
}

void RobotState::copyJointGroupPositions(const JointModelGroup* group, double* values) const {
  const std::vector<int>& indices = group->getVariableIndexList();
  for (std::size_t i = 0; i < indices.size(); ++i) values[i] = position_[static_cast<std::size_t>(indices[i])];
}

void RobotState::copyJointGroupPositions(const JointModelGroup* group, std::vector<double>& values) const {
  values.resize(group->getVariableCount());
  copyJointGroupPositions(group, values.data());
}

void RobotState::copyJointGroupPositions(const JointModelGroup* group, Eigen::VectorXd& values) const {
  values.resize(group->getVariableCount());
  copyJointGroupPositions(group, values.data());
}

void RobotState::copyJointGroupVelocities(const JointModelGroup* group, std::vector<double>& values) const {
  values.clear();
  for (const int i : group->getVariableIndexList()) values.push_back(velocity_[static_cast<std::size_t>(i)]);
}

void RobotState::setToDefaultValues() {
  model_->getVariableDefaultPositions(position_);
  zeroVelocities();
  has_velocity_ = has_acceleration_ = has_effort_ = false;
  updateMimicJoints();
}

bool RobotState::setToDefaultValues(const JointModelGroup* group, const std::string& name) {
  std::map<std::string, double> values;
  if (group == nullptr || !group->getVariableDefaultPositions(name, values)) return false;
  setVariablePositions(values);
  return true;
}

bool RobotState::setToDefaultValues(const std::string& group, const std::string& name) {
  return setToDefaultValues(getJointModelGroup(group), name);
}

void RobotState::setRandom(const JointModel& joint, std::mt19937& random) {
  double* values = position_.data() + joint.getFirstVariableIndex();
  if (joint.getType() == JointModel::FLOATING) {
    std::normal_distribution<double> normal;
    std::fill_n(values, 3, 0.0);
    for (int i = 3; i < 7; ++i) values[i] = normal(random);
    joint.enforcePositionBounds(values);
    return;
  }
  for (const VariableBounds& bounds : joint.getVariableBounds()) {
    const bool is_free = bounds.max_position_ <= bounds.min_position_;  // planar joints are not bounded
    std::uniform_real_distribution<double> uniform(is_free ? -M_PI : bounds.min_position_,
                                                   is_free ? M_PI : bounds.max_position_);
    *values++ = uniform(random);
  }
}

void RobotState::setToRandomPositions() {
  for (const JointModel* joint : model_->getActiveJointModels()) setRandom(*joint, sharedRandom());
  updateMimicJoints();
}

void RobotState::setToRandomPositions(const JointModelGroup* group) { setToRandomPositions(group, sharedRandom()); }

void RobotState::setToRandomPositions(const JointModelGroup* group, std::mt19937& random) {
  for (const JointModel* joint : group->getActiveJointModels()) setRandom(*joint, random);
  updateMimicJoints();
}

void RobotState::setToRandomPositionsNearBy(const JointModelGroup* group, const RobotState& seed, double distance) {
  std::uniform_real_distribution<double> uniform(-distance, distance);
  for (const JointModel* joint : group->getActiveJointModels()) {
    double* values = position_.data() + joint->getFirstVariableIndex();
    for (std::size_t i = 0; i < joint->getVariableCount(); ++i)
      values[i] = seed.position_[joint->getFirstVariableIndex() + i] + uniform(sharedRandom());
    joint->enforcePositionBounds(values);
  }
  updateMimicJoints();
}

void RobotState::update(bool force) {
  if (force) updateMimicJoints();
  computeTransforms();
}

void RobotState::computeTransforms() const {
  if (!is_stale_) return;
  for (const LinkModel* link : model_->getLinkModels()) {  // parents first
    const JointModel* joint = link->getParentJointModel();
    Eigen::Isometry3d pose = link->getJointOriginTransform() * joint->computeTransform(getJointPositions(joint));
    if (link->getParentLinkModel() != nullptr)
      pose = transforms_[static_cast<std::size_t>(link->getParentLinkModel()->getLinkIndex())] * pose;
    transforms_[static_cast<std::size_t>(link->getLinkIndex())] = pose;
  }
  is_stale_ = false;
}

const Eigen::Isometry3d& RobotState::getGlobalLinkTransform(const LinkModel* link) const {
  if (link == nullptr) throw Exception("there is no link to give the pose of");
  computeTransforms();
  return transforms_[static_cast<std::size_t>(link->getLinkIndex())];
}

const Eigen::Isometry3d& RobotState::getGlobalLinkTransform(const std::string& link) const {
  const LinkModel* model = model_->getLinkModel(link);
  if (model == nullptr) throw Exception("link '" + link + "' is not known to model '" + model_->getName() + "'");
  return getGlobalLinkTransform(model);
}

bool RobotState::knowsFrameTransform(const std::string& frame) const {
  const std::string name = !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
  return name == model_->getModelFrame() || model_->hasLinkModel(name);
}

const Eigen::Isometry3d& RobotState::getFrameTransform(const std::string& frame) const {
  static const Eigen::Isometry3d kIdentity = Eigen::Isometry3d::Identity();
  const std::string name = !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
  if (model_->hasLinkModel(name)) return getGlobalLinkTransform(name);
  if (name == model_->getModelFrame()) return kIdentity;
  throw Exception("frame '" + frame + "' is not known to model '" + model_->getName() + "'");
}

bool RobotState::satisfiesBounds(double margin) const {
  const auto& joints = model_->getActiveJointModels();
  return std::all_of(joints.begin(), joints.end(),
                     [&](const JointModel* joint) { return satisfiesBounds(joint, margin); });
}

bool RobotState::satisfiesBounds(const JointModelGroup* group, double margin) const {
  const auto& joints = group->getActiveJointModels();
  return std::all_of(joints.begin(), joints.end(),
                     [&](const JointModel* joint) { return satisfiesBounds(joint, margin); });
}

void RobotState::enforceBounds() {
  for (const JointModel* joint : model_->getActiveJointModels())
    joint->enforcePositionBounds(position_.data() + joint->getFirstVariableIndex());
  updateMimicJoints();
}

void RobotState::enforceBounds(const JointModelGroup* group) {
  for (const JointModel* joint : group->getActiveJointModels())
    joint->enforcePositionBounds(position_.data() + joint->getFirstVariableIndex());
  updateMimicJoints();
}

double RobotState::distance(const RobotState& other) const {
  double sum = 0.0;
  for (const JointModel* joint : model_->getActiveJointModels())
    sum += joint->distance(getJointPositions(joint), other.getJointPositions(joint));
  return sum;
}

double RobotState::distance(const RobotState& other, const JointModelGroup* group) const {
  double sum = 0.0;
  for (const JointModel* joint : group->getActiveJointModels())
    sum += joint->distance(getJointPositions(joint), other.getJointPositions(joint));
  return sum;
}

void RobotState::interpolate(const RobotState& to, double t, RobotState& state) const {
  for (const JointModel* joint : model_->getActiveJointModels()) {
    joint->interpolate(getJointPositions(joint), to.getJointPositions(joint), t,
                       state.position_.data() + joint->getFirstVariableIndex());
  }
  state.updateMimicJoints();
}

void RobotState::interpolate(const RobotState& to, double t, RobotState& state, const JointModelGroup* group) const {
  for (const JointModel* joint : group->getActiveJointModels()) {
    joint->interpolate(getJointPositions(joint), to.getJointPositions(joint), t,
                       state.position_.data() + joint->getFirstVariableIndex());
  }
  state.updateMimicJoints();
}

bool RobotState::hasAttachedBody(const std::string& id) const {
  return std::any_of(attached_.begin(), attached_.end(),
                     [&id](const moveit_msgs::AttachedCollisionObject& body) { return body.object.id == id; });
}

void RobotState::attachBody(const moveit_msgs::AttachedCollisionObject& body) {
  clearAttachedBody(body.object.id);
  attached_.push_back(body);
}

bool RobotState::clearAttachedBody(const std::string& id) {
  const auto end =
      std::remove_if(attached_.begin(), attached_.end(),
                     [&id](const moveit_msgs::AttachedCollisionObject& body) { return body.object.id == id; });
  const bool is_found = end != attached_.end();
  attached_.erase(end, attached_.end());
  return is_found;
}

void RobotState::printStatePositions(std::ostream& out) const {
  for (std::size_t i = 0; i < position_.size(); ++i)
    out << model_->getVariableNames()[i] << '=' << position_[i] << '\n';
}

std::ostream& operator<<(std::ostream& out, const RobotState& state) {
  state.printStateInfo(out);
  return out;
}

}  // namespace core
}  // namespace moveit
