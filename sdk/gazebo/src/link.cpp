#include <algorithm>

#include <gazebo/common/Console.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo {
namespace physics {

using ignition::math::Pose3d;
using ignition::math::Vector3d;

Link::Link(EntityPtr parent)
    : Entity(parent),
      number_(-1),
      gravity_(true),
      written_gravity_(true),
      self_collide_(false),
      kinematic_(false),
      warned_(false),
      wants_acceleration_(false),
      has_last_twist_(false) {
  type_ |= LINK;
}

ModelPtr Link::GetModel() const { return boost::static_pointer_cast<Model>(parent_); }

CollisionPtr Link::GetCollision(const std::string& name) {
  for (const CollisionPtr& collision : collisions_)
    if (collision->GetName() == name || collision->GetScopedName() == name) return collision;
  return CollisionPtr();
}

CollisionPtr Link::GetCollision(unsigned int index) const {
  return index < collisions_.size() ? collisions_[index] : CollisionPtr();
}

CollisionPtr Link::GetCollisionById(unsigned int id) const {
  for (const CollisionPtr& collision : collisions_)
    if (collision->GetId() == id) return collision;
  return CollisionPtr();
}

Link_V Link::GetParentJointsLinks() const {
  Link_V links;
  for (const JointPtr& joint : parent_joints_)
    if (joint->GetParent()) links.push_back(joint->GetParent());
  return links;
}

Link_V Link::GetChildJointsLinks() const {
  Link_V links;
  for (const JointPtr& joint : child_joints_)
    if (joint->GetChild()) links.push_back(joint->GetChild());
  return links;
}

std::string Link::GetSensorName(unsigned int index) const {
  return index < sensor_names_.size() ? sensor_names_[index] : std::string();
}

Pose3d Link::WorldPose() const {
  const TrundleGazeboHost* host = world_->Host();
  double v[7];
  if (!host->read(host->self, TRUNDLE_LINK_POSE, number_, 0, v, 7)) return initial_;
  return Pose3d(v[0], v[1], v[2], v[3], v[4], v[5], v[6]);
}

Pose3d Link::RelativePose() const { return WorldPose() - GetModel()->WorldPose(); }

void Link::SetWorldPose(const Pose3d& pose, bool, bool) {
  const TrundleGazeboHost* host = world_->Host();
  const double v[7] = {pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z(), pose.Rot().W(),
                       pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()};
  if (host->write(host->self, TRUNDLE_SET_POSE, number_, 0, v, 7)) return;
  if (!warned_)
    gzwarn << "link " << GetScopedName() << " is held by a joint, or fixed; SetWorldPose does not move it\n";
  warned_ = true;
}

Pose3d Link::WorldCoGPose() const { return Pose3d(WorldPose().CoordPositionAdd(inertial_->CoG()), WorldPose().Rot()); }

ignition::math::Matrix3d Link::WorldInertiaMatrix() const {
  const ignition::math::Matrix3d rotation(WorldInertialPose().Rot());
  return rotation * inertial_->MOI() * rotation.Transposed();
}

void Link::SetGravityMode(bool is_on) {
  gravity_ = is_on;
  Link_V& changed = world_->weight_changes_;
  const LinkPtr self = boost::static_pointer_cast<Link>(shared_from_this());
  changed.erase(std::remove(changed.begin(), changed.end(), self), changed.end());
  if (gravity_ != written_gravity_) changed.push_back(self);
}

void Link::ChangeWeight() {
  AddWrench(world_->Gravity() * (gravity_ ? inertial_->Mass() : -inertial_->Mass()), Vector3d::Zero);
}

bool Link::Twist(double (&v)[6]) const {
  const TrundleGazeboHost* host = world_->Host();
  if (host->read(host->self, TRUNDLE_LINK_TWIST, number_, 0, v, 6)) return true;
  for (double& value : v) value = 0.0;
  return false;
}

Vector3d Link::WorldLinearVel() const {
  double v[6];
  Twist(v);
  return Vector3d(v[0], v[1], v[2]);
}

Vector3d Link::WorldAngularVel() const {
  double v[6];
  Twist(v);
  return Vector3d(v[3], v[4], v[5]);
}

Vector3d Link::WorldLinearVel(const Vector3d& offset) const {
  double v[6];
  Twist(v);
  return Vector3d(v[0], v[1], v[2]) + Vector3d(v[3], v[4], v[5]).Cross(WorldPose().Rot().RotateVector(offset));
}

Vector3d Link::WorldLinearVel(const Vector3d& offset, const ignition::math::Quaterniond& rotation) const {
  double v[6];
  Twist(v);
  return Vector3d(v[0], v[1], v[2]) + Vector3d(v[3], v[4], v[5]).Cross(rotation.RotateVector(offset));
}

Vector3d Link::WorldLinearAccel() const {
  wants_acceleration_ = true;
  return linear_accel_;
}

Vector3d Link::WorldAngularAccel() const {
  wants_acceleration_ = true;
  return angular_accel_;
}

void Link::SetWorldTwist(const Vector3d& linear, const Vector3d& angular, bool) {
  const TrundleGazeboHost* host = world_->Host();
  const double v[6] = {linear.X(), linear.Y(), linear.Z(), angular.X(), angular.Y(), angular.Z()};
  if (host->write(host->self, TRUNDLE_SET_TWIST, number_, 0, v, 6)) return;
  if (!warned_ && !is_static_)
    gzwarn << "link " << GetScopedName() << " is held by a joint, or fixed; its velocity cannot be set alone\n";
  warned_ = true;
}

void Link::SetLinearVel(const Vector3d& velocity) { SetWorldTwist(velocity, WorldAngularVel()); }
void Link::SetAngularVel(const Vector3d& velocity) { SetWorldTwist(WorldLinearVel(), velocity); }

void Link::AddWrench(const Vector3d& force, const Vector3d& torque) {
  const TrundleGazeboHost* host = world_->Host();
  const double v[6] = {force.X(), force.Y(), force.Z(), torque.X(), torque.Y(), torque.Z()};
  if (!host->write(host->self, TRUNDLE_ADD_WRENCH, number_, 0, v, 6)) return;
  force_ += force;
  torque_ += torque;
}

void Link::SetForce(const Vector3d& force) { AddWrench(force - force_, Vector3d()); }
void Link::SetTorque(const Vector3d& torque) { AddWrench(Vector3d(), torque - torque_); }
void Link::AddForce(const Vector3d& force) { AddWrench(force, Vector3d()); }
void Link::AddRelativeForce(const Vector3d& force) { AddForce(WorldPose().Rot().RotateVector(force)); }
void Link::AddForceAtWorldPosition(const Vector3d& force, const Vector3d& position) {
  AddWrench(force, (position - WorldCoGPose().Pos()).Cross(force));
}
void Link::AddForceAtRelativePosition(const Vector3d& force, const Vector3d& position) {
  AddForceAtWorldPosition(force, WorldCoGPose().Pos() + WorldPose().Rot().RotateVector(position));
}
void Link::AddLinkForce(const Vector3d& force, const Vector3d& offset) {
  const Pose3d pose = WorldPose();
  AddForceAtWorldPosition(pose.Rot().RotateVector(force), pose.CoordPositionAdd(offset));
}
void Link::AddTorque(const Vector3d& torque) { AddWrench(Vector3d(), torque); }
void Link::AddRelativeTorque(const Vector3d& torque) { AddTorque(WorldPose().Rot().RotateVector(torque)); }

void Link::AttachStaticModel(ModelPtr& model, const Pose3d& offset) {
  model->SetWorldPose(WorldPose() * offset);
  const std::string joint = "attached_" + GetScopedName() + "_" + model->GetName();
  world_->Request({"attach", joint, "fixed", GetScopedName(), model->GetLink()->GetScopedName()});
  attached_.push_back(model->GetName());
}

void Link::DetachStaticModel(const std::string& model) {
  for (std::size_t i = 0; i < attached_.size(); ++i)
    if (attached_[i] == model) {
      world_->Request({"detach", "attached_" + GetScopedName() + "_" + model});
      attached_.erase(attached_.begin() + static_cast<std::ptrdiff_t>(i));
      return;
    }
}

void Link::DetachAllStaticModels() {
  while (!attached_.empty()) DetachStaticModel(std::string(attached_.back()));
}

void Link::EndStep(double step_s) {
  force_ = torque_ = Vector3d();
  if (!wants_acceleration_) return;
  double v[6];
  Twist(v);
  const Vector3d linear(v[0], v[1], v[2]), angular(v[3], v[4], v[5]);
  if (has_last_twist_ && step_s > 0.0) {
    linear_accel_ = (linear - last_linear_) / step_s;
    angular_accel_ = (angular - last_angular_) / step_s;
  }
  last_linear_ = linear;
  last_angular_ = angular;
  has_last_twist_ = true;
}

void Link::SetCollideMode(const std::string& mode) {
  if (mode != "none" && mode != "all") {
    gzerr << "link " << GetScopedName() << ": collide mode \"" << mode << "\" is not known; there are all and none\n";
    return;
  }
  const TrundleGazeboHost* host = world_->Host();
  const double collides = mode == "all";
  host->write(host->self, TRUNDLE_SET_COLLIDE, number_, 0, &collides, 1);
}

}  // namespace physics
}  // namespace gazebo
