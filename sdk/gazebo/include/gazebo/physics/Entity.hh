// A part of the world with a pose: model, link or collision. Vectors "World…" have world axes, "Relative…" the
// entity's.
#ifndef GAZEBO_PHYSICS_ENTITY_HH_
#define GAZEBO_PHYSICS_ENTITY_HH_

#include <string>

#include <ignition/math/Box.hh>
#include <ignition/math/Pose3.hh>

#include <gazebo/common/CommonTypes.hh>
#include <gazebo/common/Time.hh>
#include <gazebo/math/Box.hh>
#include <gazebo/math/Pose.hh>
#include <gazebo/physics/Base.hh>

namespace gazebo {
namespace physics {

class Entity : public Base {
 public:
  explicit Entity(BasePtr parent);

  void SetStatic(const bool& is_static) { is_static_ = is_static; }
  bool IsStatic() const;
  bool IsCanonicalLink() const { return is_canonical_; }
  ModelPtr GetParentModel();
  CollisionPtr GetChildCollision(const std::string& name);
  LinkPtr GetChildLink(const std::string& name);
  void SetInitialRelativePose(const ignition::math::Pose3d& pose) { initial_ = pose; }
  ignition::math::Pose3d InitialRelativePose() const { return initial_; }
  virtual ignition::math::Pose3d RelativePose() const;
  virtual void SetRelativePose(const ignition::math::Pose3d& pose, bool notify = true, bool publish = true);
  virtual ignition::math::Pose3d WorldPose() const;
  virtual void SetWorldPose(const ignition::math::Pose3d& pose, bool notify = true, bool publish = true);
  const ignition::math::Pose3d DirtyPose() const { return WorldPose(); }
  virtual ignition::math::Vector3d WorldLinearVel() const { return ignition::math::Vector3d(); }
  virtual ignition::math::Vector3d WorldAngularVel() const { return ignition::math::Vector3d(); }
  virtual ignition::math::Vector3d WorldLinearAccel() const { return ignition::math::Vector3d(); }
  virtual ignition::math::Vector3d WorldAngularAccel() const { return ignition::math::Vector3d(); }
  ignition::math::Vector3d RelativeLinearVel() const { return Own(WorldLinearVel()); }
  ignition::math::Vector3d RelativeAngularVel() const { return Own(WorldAngularVel()); }
  ignition::math::Vector3d RelativeLinearAccel() const { return Own(WorldLinearAccel()); }
  ignition::math::Vector3d RelativeAngularAccel() const { return Own(WorldAngularAccel()); }

  // Of its collisions, with the world's axes; meshes and planes count as points.
  ignition::math::Box BoundingBox() const;
  ignition::math::Box CollisionBoundingBox() const { return BoundingBox(); }

  // Move along poses in the world before each step; `finished` is called at the end of what is no loop.
  void SetAnimation(const common::PoseAnimationPtr& animation) { SetAnimation(animation, boost::function<void()>()); }
  void SetAnimation(const common::PoseAnimationPtr& animation, boost::function<void()> finished);
  virtual void StopAnimation();

  // Names up to Gazebo 8.
  math::Pose GetWorldPose() const { return WorldPose(); }
  math::Pose GetRelativePose() const { return RelativePose(); }
  math::Pose GetInitialRelativePose() const { return InitialRelativePose(); }
  math::Pose GetDirtyPose() const { return DirtyPose(); }
  math::Box GetBoundingBox() const { return BoundingBox(); }
  math::Box GetCollisionBoundingBox() const { return BoundingBox(); }
  math::Vector3 GetWorldLinearVel() const { return WorldLinearVel(); }
  math::Vector3 GetWorldAngularVel() const { return WorldAngularVel(); }
  math::Vector3 GetWorldLinearAccel() const { return WorldLinearAccel(); }
  math::Vector3 GetWorldAngularAccel() const { return WorldAngularAccel(); }
  math::Vector3 GetRelativeLinearVel() const { return RelativeLinearVel(); }
  math::Vector3 GetRelativeAngularVel() const { return RelativeAngularVel(); }
  math::Vector3 GetRelativeLinearAccel() const { return RelativeLinearAccel(); }
  math::Vector3 GetRelativeAngularAccel() const { return RelativeAngularAccel(); }

 protected:
  friend struct Builder;
  ignition::math::Vector3d Own(const ignition::math::Vector3d& v) const {
    return WorldPose().Rot().RotateVectorReverse(v);
  }

  // Continue an animation before a step at a time.
  virtual void Animate(const common::Time& time);
  // Register for Animate.
  void StartAnimation();

  ignition::math::Pose3d initial_;
  bool is_static_, is_canonical_;
  common::Time animated_time_;

 private:
  friend class World;
  common::PoseAnimationPtr animation_;
  boost::function<void()> animation_finished_;
};

}  // namespace physics
}  // namespace gazebo

#endif
