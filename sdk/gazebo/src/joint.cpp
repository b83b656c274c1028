#include <algorithm>
#include <cstdlib>

#include <gazebo/common/Console.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo {
namespace physics {

using ignition::math::Pose3d;
using ignition::math::Vector3d;

namespace {

// Numbers of any type that callers pass.
bool number_of(const boost::any& value, double& number) {
  if (const double* d = boost::any_cast<double>(&value)) number = *d;
  else if (const float* f = boost::any_cast<float>(&value)) number = *f;
  else if (const int* i = boost::any_cast<int>(&value)) number = *i;
  else if (const unsigned int* u = boost::any_cast<unsigned int>(&value)) number = *u;
  else if (const std::string* s = boost::any_cast<std::string>(&value)) number = std::strtod(s->c_str(), nullptr);
  else return false;
  return true;
}

}  // namespace

Joint::Joint(BasePtr parent) : Base(parent), number_(-1), is_made_(false), is_pending_(false) {
  type_ |= JOINT;
  for (int i = 0; i < 2; ++i) {
    axis_[i] = Vector3d::UnitZ;
    lower_[i] = -1e16;
    upper_[i] = 1e16;
    effort_limit_[i] = velocity_limit_[i] = -1.0;
    damping_[i] = fmax_[i] = effort_[i] = 0.0;
  }
}

int Joint::Number() const {
  const TrundleGazeboHost* host = world_->Host();
  if (number_ < 0) {
    const std::string name = is_made_ ? attached_name_ : GetScopedName();
    number_ = host->find(host->self, TRUNDLE_JOINT, name.c_str());
  }
  return number_;
}

unsigned int Joint::DOF() const {
  const TrundleGazeboHost* host = world_->Host();
  double axes = 0.0;
  host->read(host->self, TRUNDLE_JOINT_AXES, Number(), 0, &axes, 1);
  return static_cast<unsigned int>(axes);
}

bool Joint::AreConnected(LinkPtr a, LinkPtr b) const {
  return (parent_link_ == a && child_link_ == b) || (parent_link_ == b && child_link_ == a);
}

double Joint::Position(unsigned int axis) const {
  const TrundleGazeboHost* host = world_->Host();
  double value = 0.0;
  host->read(host->self, TRUNDLE_JOINT_POSITION, Number(), static_cast<int>(axis), &value, 1);
  return value;
}

double Joint::GetVelocity(unsigned int axis) const {
  const TrundleGazeboHost* host = world_->Host();
  double value = 0.0;
  host->read(host->self, TRUNDLE_JOINT_VELOCITY, Number(), static_cast<int>(axis), &value, 1);
  return value;
}

JointWrench Joint::GetForceTorque(unsigned int) const {
  const TrundleGazeboHost* host = world_->Host();
  double v[6];
  JointWrench wrench;
  if (host->read(host->self, TRUNDLE_JOINT_WRENCH, Number(), 0, v, 6) < 6) return wrench;
  const Vector3d force(v[0], v[1], v[2]), torque(v[3], v[4], v[5]);
  const auto parent = parent_link_ ? parent_link_->WorldPose().Rot() : ignition::math::Quaterniond();
  const auto child = child_link_ ? child_link_->WorldPose().Rot() : ignition::math::Quaterniond();
  wrench.body1Force = parent.RotateVectorReverse(force);
  wrench.body1Torque = parent.RotateVectorReverse(torque);
  wrench.body2Force = child.RotateVectorReverse(-force);
  wrench.body2Torque = child.RotateVectorReverse(-torque);
  return wrench;
}

double Joint::GetForce(unsigned int axis) { return effort_[Index(axis)]; }

bool Joint::SetPosition(unsigned int axis, double position, bool) {
  const TrundleGazeboHost* host = world_->Host();
  const double value = std::min(std::max(position, LowerLimit(axis)), UpperLimit(axis));
  return host->write(host->self, TRUNDLE_SET_POSITION, Number(), static_cast<int>(axis), &value, 1) != 0;
}

void Joint::SetVelocity(unsigned int axis, double velocity) {
  const TrundleGazeboHost* host = world_->Host();
  const double values[2] = {velocity, fmax_[Index(axis)]};
  if (values[1] > 0.0) host->write(host->self, TRUNDLE_DRIVE, Number(), static_cast<int>(axis), values, 2);
  else host->write(host->self, TRUNDLE_SET_SPEED, Number(), static_cast<int>(axis), values, 1);
}

void Joint::SetForce(unsigned int axis, double effort) {
  const double limit = effort_limit_[Index(axis)];
  if (limit >= 0.0) effort = std::min(std::max(effort, -limit), limit);
  const TrundleGazeboHost* host = world_->Host();
  if (host->write(host->self, TRUNDLE_ADD_EFFORT, Number(), static_cast<int>(axis), &effort, 1))
    effort_[Index(axis)] += effort;
}

void Joint::SetMaxForce(unsigned int axis, double effort) {
  fmax_[Index(axis)] = std::max(effort, 0.0);
  SetVelocity(axis, 0.0);
}

void Joint::SetUpperLimit(unsigned int axis, double limit) {
  upper_[Index(axis)] = limit;
  is_pending_ = is_made_ && child_link_;
}

void Joint::SetLowerLimit(unsigned int axis, double limit) {
  lower_[Index(axis)] = limit;
  is_pending_ = is_made_ && child_link_;
}

bool Joint::SetParam(const std::string& key, unsigned int axis, const boost::any& value) {
  double number = 0.0;
  if (!number_of(value, number)) return false;
  if (key == "fmax") SetMaxForce(axis, number);
  else if (key == "vel") SetVelocity(axis, number);
  else if (key == "hi_stop") SetUpperLimit(axis, number);
  else if (key == "lo_stop") SetLowerLimit(axis, number);
  else return false;
  return true;
}

double Joint::GetParam(const std::string& key, unsigned int axis) {
  if (key == "fmax") return fmax_[Index(axis)];
  if (key == "vel") return GetVelocity(axis);
  if (key == "hi_stop") return UpperLimit(axis);
  if (key == "lo_stop") return LowerLimit(axis);
  if (key == "effort") return effort_limit_[Index(axis)];
  return 0.0;
}

Pose3d Joint::WorldPose() const { return child_link_ ? child_link_->WorldPose() * child_from_joint_ : Pose3d(); }
Vector3d Joint::GlobalAxis(unsigned int axis) const { return WorldPose().Rot().RotateVector(LocalAxis(axis)); }
Vector3d Joint::Anchor(unsigned int) const { return WorldPose().Pos(); }

void Joint::Load(LinkPtr parent, LinkPtr child, const Pose3d& pose) {
  child_from_joint_ = pose;
  Attach(parent, child);
}

void Joint::Attach(LinkPtr parent, LinkPtr child) {
  if (!is_made_) {
    gzwarn << "joint " << GetScopedName() << " is part of its model; only joints of CreateJoint are attached\n";
    return;
  }
  parent_link_ = parent;
  child_link_ = child;
  is_pending_ = child != nullptr;
}

// Plugins attach first and set limits afterwards, so joints are connected at the end of a call. One whose limits are
// equal is rigid, which is how plugins hold what they grasp.
void Joint::Connect() {
  if (!is_pending_) return;
  is_pending_ = false;
  attached_name_ = "plugin_joint_" + std::to_string(GetId()) + (name_.empty() ? "" : "_" + name_);
  const bool is_rigid = type_name_ == "fixed" || upper_[0] <= lower_[0];
  const Vector3d axis = GlobalAxis(0);
  world_->Request({"attach", attached_name_, is_rigid ? "fixed" : type_name_,
                   parent_link_ ? parent_link_->GetScopedName() : "world", child_link_->GetScopedName()},
                  {axis.X(), axis.Y(), axis.Z(), lower_[0], upper_[0], child_from_joint_.Pos().X(),
                   child_from_joint_.Pos().Y(), child_from_joint_.Pos().Z()});
}

void Joint::Init() {}

void Joint::Detach() {
  is_pending_ = false;
  if (attached_name_.empty()) {
    if (!is_made_) gzwarn << "joint " << GetScopedName() << " is part of its model and stays\n";
    return;
  }
  world_->Request({"detach", attached_name_});
  attached_name_.clear();
  number_ = -1;
}

void Joint::EndStep() {
  effort_[0] = effort_[1] = 0.0;
  if (update_.ConnectionCount()) update_.SignalIn(world_.get());
}

void JointController::AddJoint(JointPtr joint) {
  position_pids_[joint->GetScopedName()].Init(1, 0.1, 0.01, 1, -1, 1000, -1000);
  velocity_pids_[joint->GetScopedName()].Init(1, 0.1, 0.01, 1, -1, 1000, -1000);
}

void JointController::RemoveJoint(Joint* joint) {
  const std::string name = joint->GetScopedName();
  for (auto* values : {&positions_, &velocities_, &forces_}) values->erase(name);
  for (auto* pids : {&position_pids_, &velocity_pids_}) pids->erase(name);
}

void JointController::Reset() {
  positions_.clear();
  velocities_.clear();
  forces_.clear();
  for (auto* pids : {&position_pids_, &velocity_pids_})
    for (auto& pid : *pids) pid.second.Reset();
}

JointPtr JointController::Find(const std::string& name) const { return model_->GetJoint(name); }

bool JointController::SetPositionTarget(const std::string& joint, double target) {
  return Find(joint) && (positions_[joint] = target, true);
}
bool JointController::SetVelocityTarget(const std::string& joint, double target) {
  return Find(joint) && (velocities_[joint] = target, true);
}
bool JointController::SetForce(const std::string& joint, double effort) {
  return Find(joint) && (forces_[joint] = effort, true);
}
void JointController::SetJointPosition(const std::string& joint, double position, int axis) {
  SetJointPosition(Find(joint), position, axis);
}
void JointController::SetJointPosition(JointPtr joint, double position, int axis) {
  if (joint) joint->SetPosition(static_cast<unsigned int>(axis), position);
}
void JointController::SetJointPositions(const std::map<std::string, double>& positions) {
  for (const auto& position : positions) SetJointPosition(position.first, position.second);
}
std::map<std::string, JointPtr> JointController::GetJoints() const {
  std::map<std::string, JointPtr> joints;
  for (const JointPtr& joint : model_->GetJoints()) joints[joint->GetScopedName()] = joint;
  return joints;
}

void JointController::Update() {
  const common::Time dt(step_s_);
  for (const auto& force : forces_)
    if (const JointPtr joint = Find(force.first)) joint->SetForce(0, force.second);
  for (const auto& target : positions_)
    if (const JointPtr joint = Find(target.first)) {
      common::PID& pid = position_pids_[target.first];
      joint->SetForce(0, pid.Update(joint->Position(0) - target.second, dt));
    }
  for (const auto& target : velocities_)
    if (const JointPtr joint = Find(target.first)) {
      common::PID& pid = velocity_pids_[target.first];
      joint->SetForce(0, pid.Update(joint->GetVelocity(0) - target.second, dt));
    }
}

}  // namespace physics
}  // namespace gazebo
