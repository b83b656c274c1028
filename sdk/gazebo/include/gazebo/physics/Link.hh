#ifndef GAZEBO_PHYSICS_LINK_HH_
#define GAZEBO_PHYSICS_LINK_HH_

#include <string>
#include <vector>

#include <gazebo/common/Event.hh>
#include <gazebo/physics/Entity.hh>
#include <gazebo/physics/Inertial.hh>

namespace gazebo {
namespace physics {

// A rigid body. Forces and torques add up, and act for the coming step, as in Gazebo.
class Link : public Entity {
 public:
  explicit Link(EntityPtr parent);

  ModelPtr GetModel() const;
  InertialPtr GetInertial() const { return inertial_; }
  CollisionPtr GetCollision(const std::string& name);
  CollisionPtr GetCollision(unsigned int index) const;
  CollisionPtr GetCollisionById(unsigned int id) const;
  const Collision_V& GetCollisions() const { return collisions_; }
  Joint_V GetParentJoints() const { return parent_joints_; }
  Joint_V GetChildJoints() const { return child_joints_; }
  Link_V GetParentJointsLinks() const;
  Link_V GetChildJointsLinks() const;
  unsigned int GetSensorCount() const { return static_cast<unsigned int>(sensor_names_.size()); }
  // `world::model::link::sensor`
  std::string GetSensorName(unsigned int index) const;
  bool GetGravityMode() const { return gravity_; }
  void SetGravityMode(bool is_on);
  bool GetSelfCollide() const { return self_collide_; }
  bool GetKinematic() const { return kinematic_; }
  bool GetEnabled() const { return true; }
  void SetEnabled(bool) const {}
  void SetPublishData(bool) {}

  virtual ignition::math::Pose3d RelativePose() const;
  virtual ignition::math::Pose3d WorldPose() const;
  // Moves a link that no joint holds; another one stays, with a warning.
  virtual void SetWorldPose(const ignition::math::Pose3d& pose, bool notify = true, bool publish = true);
  ignition::math::Pose3d WorldCoGPose() const;
  ignition::math::Pose3d WorldInertialPose() const { return GetInertial()->Pose() + WorldPose(); }
  ignition::math::Matrix3d WorldInertiaMatrix() const;
  // Velocity of the frame's origin, of a point in the link's frame, of an offset with the axes of a frame in the link.
  virtual ignition::math::Vector3d WorldLinearVel() const;
  ignition::math::Vector3d WorldLinearVel(const ignition::math::Vector3d& offset) const;
  ignition::math::Vector3d WorldLinearVel(const ignition::math::Vector3d& offset,
                                          const ignition::math::Quaterniond& rotation) const;
  ignition::math::Vector3d WorldCoGLinearVel() const { return WorldLinearVel(GetInertial()->CoG()); }
  virtual ignition::math::Vector3d WorldAngularVel() const;
  // Change of the velocity in the last step over its duration.
  virtual ignition::math::Vector3d WorldLinearAccel() const;
  virtual ignition::math::Vector3d WorldAngularAccel() const;
  void SetLinearVel(const ignition::math::Vector3d& velocity);
  void SetAngularVel(const ignition::math::Vector3d& velocity);
  void SetWorldTwist(const ignition::math::Vector3d& linear, const ignition::math::Vector3d& angular,
                     bool update_children = true);
  void ResetPhysicsStates() { SetWorldTwist(ignition::math::Vector3d(), ignition::math::Vector3d()); }

  void SetForce(const ignition::math::Vector3d& force);
  void SetTorque(const ignition::math::Vector3d& torque);
  void AddForce(const ignition::math::Vector3d& force);
  void AddRelativeForce(const ignition::math::Vector3d& force);
  void AddForceAtWorldPosition(const ignition::math::Vector3d& force, const ignition::math::Vector3d& position);
  void AddForceAtRelativePosition(const ignition::math::Vector3d& force, const ignition::math::Vector3d& position);
  // Force with the link's axes, at a point in the link's frame.
  void AddLinkForce(const ignition::math::Vector3d& force,
                    const ignition::math::Vector3d& offset = ignition::math::Vector3d());
  void AddTorque(const ignition::math::Vector3d& torque);
  void AddRelativeTorque(const ignition::math::Vector3d& torque);
  // What was added for the coming step.
  ignition::math::Vector3d WorldForce() const { return force_; }
  ignition::math::Vector3d WorldTorque() const { return torque_; }
  ignition::math::Vector3d RelativeForce() const { return Own(force_); }
  ignition::math::Vector3d RelativeTorque() const { return Own(torque_); }

  // Hold a model at an offset from this link, and release it.
  void AttachStaticModel(ModelPtr& model, const ignition::math::Pose3d& offset);
  void DetachStaticModel(const std::string& model);
  void DetachAllStaticModels();

  // Names up to Gazebo 8.
  math::Pose GetWorldCoGPose() const { return WorldCoGPose(); }
  math::Pose GetWorldInertialPose() const { return WorldInertialPose(); }
  math::Matrix3 GetWorldInertiaMatrix() const { return WorldInertiaMatrix(); }
  math::Vector3 GetWorldCoGLinearVel() const { return WorldCoGLinearVel(); }
  using Entity::GetWorldLinearVel;
  math::Vector3 GetWorldLinearVel(const math::Vector3& offset) const { return WorldLinearVel(offset.Ign()); }
  math::Vector3 GetWorldLinearVel(const math::Vector3& offset, const math::Quaternion& q) const {
    return WorldLinearVel(offset.Ign(), q.Ign());
  }
  math::Vector3 GetWorldForce() const { return WorldForce(); }
  math::Vector3 GetWorldTorque() const { return WorldTorque(); }
  math::Vector3 GetRelativeForce() const { return RelativeForce(); }
  math::Vector3 GetRelativeTorque() const { return RelativeTorque(); }

  // "none": its collisions touch nothing; "all": they do again. Other modes are not known.
  void SetCollideMode(const std::string& mode);

 private:
  friend struct Builder;
  friend class Joint;
  friend class Model;
  friend class World;
  void AddWrench(const ignition::math::Vector3d& force, const ignition::math::Vector3d& torque);
  bool Twist(double (&values)[6]) const;
  void EndStep(double step_s);
  // Add or take the weight of a link whose mode is not that of its file, for the coming step.
  void ChangeWeight();

  int number_;
  InertialPtr inertial_;
  Collision_V collisions_;
  Joint_V parent_joints_, child_joints_;
  std::vector<std::string> sensor_names_, attached_;
  bool gravity_, written_gravity_, self_collide_, kinematic_, warned_;
  mutable bool wants_acceleration_;
  bool has_last_twist_;
  ignition::math::Vector3d force_, torque_, last_linear_, last_angular_, linear_accel_, angular_accel_;
};

}  // namespace physics
}  // namespace gazebo

#endif
