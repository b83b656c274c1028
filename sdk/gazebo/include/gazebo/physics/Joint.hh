#ifndef GAZEBO_PHYSICS_JOINT_HH_
#define GAZEBO_PHYSICS_JOINT_HH_

#include <limits>
#include <string>

#include <boost/any.hpp>

#include <gazebo/common/Event.hh>
#include <gazebo/math/Angle.hh>
#include <gazebo/physics/Base.hh>
#include <gazebo/physics/Entity.hh>
#include <gazebo/physics/JointWrench.hh>

namespace gazebo {
namespace physics {

// Joint between two links; positions [rad or m], speeds [rad/s or m/s], efforts [N·m or N].
class Joint : public Base {
 public:
  enum Attribute {
    FUDGE_FACTOR,
    SUSPENSION_ERP,
    SUSPENSION_CFM,
    STOP_ERP,
    STOP_CFM,
    ERP,
    CFM,
    FMAX,
    VEL,
    HI_STOP,
    LO_STOP
  };

  explicit Joint(BasePtr parent);

  LinkPtr GetParent() const { return parent_link_; }
  LinkPtr GetChild() const { return child_link_; }
  LinkPtr GetJointLink(unsigned int index) const { return index == 0 ? parent_link_ : child_link_; }
  bool AreConnected(LinkPtr a, LinkPtr b) const;
  unsigned int DOF() const;
  // Type of SDF, such as "revolute".
  const std::string& TypeName() const { return type_name_; }

  double Position(unsigned int axis = 0) const;
  double GetVelocity(unsigned int axis) const;
  // Effort that was set for the coming step.
  double GetForce(unsigned int axis);
  // What parent (1) and child (2) exert on the joint in the last step, at the joint, in the axes of each link.
  JointWrench GetForceTorque(unsigned int axis) const;
  // Sets the position at once, and returns whether there is such an axis.
  bool SetPosition(unsigned int axis, double position, bool preserve_world_velocity = false);
  // Without a largest effort the joint has the speed for one step, as if pushed; with one, its motor keeps the speed.
  void SetVelocity(unsigned int axis, double velocity);
  // Efforts add up, and act for the coming step.
  void SetForce(unsigned int axis, double effort);
  double UpperLimit(unsigned int axis = 0) const { return upper_[Index(axis)]; }
  double LowerLimit(unsigned int axis = 0) const { return lower_[Index(axis)]; }
  void SetUpperLimit(unsigned int axis, double limit);
  void SetLowerLimit(unsigned int axis, double limit);
  double GetEffortLimit(unsigned int axis) { return effort_limit_[Index(axis)]; }
  // Bounds the efforts of SetForce; negative: no bound.
  void SetEffortLimit(unsigned int axis, double limit) { effort_limit_[Index(axis)] = limit; }
  // Of the file; as in Gazebo, it bounds nothing by itself.
  double GetVelocityLimit(unsigned int axis) { return velocity_limit_[Index(axis)]; }
  void SetVelocityLimit(unsigned int axis, double limit) { velocity_limit_[Index(axis)] = limit; }
  double GetDamping(unsigned int axis) { return damping_[Index(axis)]; }
  // "vel" and "fmax": the motor's speed and largest effort; "hi_stop", "lo_stop": limits.
  bool SetParam(const std::string& key, unsigned int axis, const boost::any& value);
  double GetParam(const std::string& key, unsigned int axis);

  // Of a joint made by CreateJoint, before it is attached; axes of the world.
  void SetAxis(unsigned int axis, const ignition::math::Vector3d& direction) { axis_[Index(axis)] = direction; }
  ignition::math::Vector3d LocalAxis(unsigned int axis) const { return axis_[Index(axis)]; }
  ignition::math::Vector3d GlobalAxis(unsigned int axis) const;
  ignition::math::Vector3d Anchor(unsigned int axis) const;
  ignition::math::Pose3d WorldPose() const;
  ignition::math::Pose3d InitialAnchorPose() const { return child_from_joint_; }

  // Joints made by CreateJoint: what they connect, and where.
  void SetModel(ModelPtr model) { model_ = model; }
  void Load(LinkPtr parent, LinkPtr child, const ignition::math::Pose3d& pose);
  void Attach(LinkPtr parent, LinkPtr child);
  void Detach();
  virtual void Init();
  void SetProvideFeedback(bool) {}

  template <typename T>
  event::ConnectionPtr ConnectJointUpdate(T subscriber) {
    return update_.Connect(subscriber);
  }

  // Names up to Gazebo 8.
  math::Angle GetAngle(unsigned int axis) const { return math::Angle(Position(axis)); }
  bool SetAngle(unsigned int axis, math::Angle angle) { return SetPosition(axis, angle.Radian()); }
  unsigned int GetAngleCount() const { return DOF(); }
  math::Angle GetUpperLimit(unsigned int axis) const { return math::Angle(UpperLimit(axis)); }
  math::Angle GetLowerLimit(unsigned int axis) const { return math::Angle(LowerLimit(axis)); }
  void SetHighStop(unsigned int axis, const math::Angle& angle) { SetUpperLimit(axis, angle.Radian()); }
  void SetLowStop(unsigned int axis, const math::Angle& angle) { SetLowerLimit(axis, angle.Radian()); }
  math::Angle GetHighStop(unsigned int axis) { return math::Angle(UpperLimit(axis)); }
  math::Angle GetLowStop(unsigned int axis) { return math::Angle(LowerLimit(axis)); }
  void SetMaxForce(unsigned int axis, double effort);
  double GetMaxForce(unsigned int axis) { return fmax_[Index(axis)]; }
  math::Vector3 GetGlobalAxis(unsigned int axis) const { return GlobalAxis(axis); }
  math::Vector3 GetLocalAxis(unsigned int axis) const { return LocalAxis(axis); }
  math::Vector3 GetAnchor(unsigned int axis) const { return Anchor(axis); }
  math::Pose GetWorldPose() const { return WorldPose(); }

 private:
  friend struct Builder;
  friend class Model;
  friend class PhysicsEngine;
  friend class World;
  static unsigned int Index(unsigned int axis) { return axis < 2 ? axis : 1; }
  void EndStep();
  void Connect();
  int Number() const;

  mutable int number_;
  LinkPtr parent_link_, child_link_;
  ModelPtr model_;
  std::string type_name_, attached_name_;
  bool is_made_, is_pending_;
  ignition::math::Pose3d child_from_joint_;
  ignition::math::Vector3d axis_[2];
  double lower_[2], upper_[2], effort_limit_[2], velocity_limit_[2], damping_[2], fmax_[2], effort_[2];
  event::EventT<void()> update_;
};

}  // namespace physics
}  // namespace gazebo

#endif
