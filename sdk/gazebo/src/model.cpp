#include <boost/make_shared.hpp>

#include <gazebo/common/Console.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo {
namespace physics {

using ignition::math::Pose3d;
using ignition::math::Vector3d;

Model::Model(BasePtr parent) : Entity(parent), self_collide_(false), plugin_count_(0) { type_ |= MODEL; }

LinkPtr Model::GetLink(const std::string& name) const {
  for (const LinkPtr& link : links_)
    if ((name == "canonical" && link->IsCanonicalLink()) || link->GetName() == name || link->GetScopedName() == name)
      return link;
  return LinkPtr();
}

LinkPtr Model::GetLinkById(unsigned int id) const {
  for (const LinkPtr& link : links_)
    if (link->GetId() == id) return link;
  return LinkPtr();
}

JointPtr Model::GetJoint(const std::string& name) {
  for (const JointPtr& joint : joints_)
    if (joint->GetName() == name || joint->GetScopedName() == name) return joint;
  return JointPtr();
}

JointControllerPtr Model::GetJointController() {
  if (!controller_) {
    controller_ = boost::make_shared<JointController>(boost::static_pointer_cast<Model>(shared_from_this()));
    for (const JointPtr& joint : joints_) controller_->AddJoint(joint);
  }
  return controller_;
}

unsigned int Model::GetSensorCount() const {
  unsigned int count = 0;
  for (const LinkPtr& link : links_) count += link->GetSensorCount();
  return count;
}

Pose3d Model::WorldPose() const {
  const LinkPtr base = GetLink();
  return base ? base->WorldPose() * base->InitialRelativePose().Inverse() : initial_;
}

void Model::SetWorldPose(const Pose3d& pose, bool, bool) {
  const TrundleGazeboHost* host = world_->Host();
  const Pose3d moved = pose * WorldPose().Inverse();
  bool is_moved = false;
  for (const LinkPtr& link : links_) {
    double is_free = 0.0;
    host->read(host->self, TRUNDLE_LINK_IS_FREE, link->number_, 0, &is_free, 1);
    if (is_free == 0.0) continue;
    link->SetWorldPose(moved * link->WorldPose());
    is_moved = true;
  }
  if (!is_moved)
    world_->Request({"set_model_pose", name_}, {pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z(), pose.Rot().W(),
                                                pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()});
}

void Model::SetLinkWorldPose(const Pose3d& pose, std::string link) {
  if (const LinkPtr found = GetLink(link)) SetLinkWorldPose(pose, found);
}

void Model::SetLinkWorldPose(const Pose3d& pose, const LinkPtr& link) {
  SetWorldPose(pose * link->WorldPose().Inverse() * WorldPose());
}

Vector3d Model::WorldLinearVel() const {
  const LinkPtr base = GetLink();
  return base ? base->WorldLinearVel(base->InitialRelativePose().Inverse().Pos()) : Vector3d();
}
Vector3d Model::WorldAngularVel() const {
  const LinkPtr base = GetLink();
  return base ? base->WorldAngularVel() : Vector3d();
}
Vector3d Model::WorldLinearAccel() const {
  const LinkPtr base = GetLink();
  return base ? base->WorldLinearAccel() : Vector3d();
}
Vector3d Model::WorldAngularAccel() const {
  const LinkPtr base = GetLink();
  return base ? base->WorldAngularAccel() : Vector3d();
}

void Model::SetWorldTwist(const Vector3d& linear, const Vector3d& angular, bool) {
  const TrundleGazeboHost* host = world_->Host();
  for (const LinkPtr& link : links_) {
    double is_free = 0.0;
    host->read(host->self, TRUNDLE_LINK_IS_FREE, link->number_, 0, &is_free, 1);
    if (is_free != 0.0) link->SetWorldTwist(linear, angular);
  }
}

void Model::SetLinearVel(const Vector3d& velocity) {
  const LinkPtr base = GetLink();
  if (base) SetWorldTwist(velocity, base->WorldAngularVel());
}

void Model::SetAngularVel(const Vector3d& velocity) {
  const LinkPtr base = GetLink();
  if (base) SetWorldTwist(base->WorldLinearVel(), velocity);
}

void Model::SetJointPosition(const std::string& joint, double position, int axis) {
  if (const JointPtr found = GetJoint(joint)) found->SetPosition(static_cast<unsigned int>(axis), position);
}

void Model::SetJointPositions(const std::map<std::string, double>& positions) {
  for (const auto& position : positions) SetJointPosition(position.first, position.second);
}

void Model::ResetPhysicsStates() {
  SetWorldTwist(Vector3d(), Vector3d());
  const TrundleGazeboHost* host = world_->Host();
  const double zero = 0.0;
  for (const JointPtr& joint : joints_)
    for (unsigned int axis = 0; axis < joint->DOF(); ++axis)
      host->write(host->self, TRUNDLE_SET_SPEED, joint->Number(), static_cast<int>(axis), &zero, 1);
}

void Model::Reset() { world_->Request({"reset_model", name_}); }

JointPtr Model::CreateJoint(const std::string& name, const std::string& type, LinkPtr parent, LinkPtr child) {
  if (GetJoint(name)) {
    gzwarn << "model " << name_ << " has a joint " << name << " already\n";
    return JointPtr();
  }
  const JointPtr joint = world_->Physics()->CreateJoint(type, boost::static_pointer_cast<Model>(shared_from_this()));
  joint->SetName(name);
  joint->Attach(parent, child);
  joints_.push_back(joint);
  return joint;
}

void Model::SetCollideMode(const std::string& mode) {
  for (const LinkPtr& link : links_) link->SetCollideMode(mode);
}

bool Model::RemoveJoint(const std::string& name) {
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (joints_[i]->GetName() == name && joints_[i]->is_made_) {
      joints_[i]->Detach();
      joints_.erase(joints_.begin() + static_cast<std::ptrdiff_t>(i));
      return true;
    }
  return false;
}

void Model::AttachStaticModel(ModelPtr& model, Pose3d offset) {
  if (const LinkPtr base = GetLink()) base->AttachStaticModel(model, offset);
}

void Model::DetachStaticModel(const std::string& model) {
  for (const LinkPtr& link : links_) link->DetachStaticModel(model);
}

}  // namespace physics
}  // namespace gazebo
