#ifndef GAZEBO_PHYSICS_COLLISION_HH_
#define GAZEBO_PHYSICS_COLLISION_HH_

#include <gazebo/physics/Entity.hh>
#include <gazebo/physics/Shape.hh>
#include <gazebo/physics/SurfaceParams.hh>

namespace gazebo {
namespace physics {

class Collision : public Entity {
 public:
  explicit Collision(LinkPtr link);

  LinkPtr GetLink() const;
  ModelPtr GetModel() const;
  ShapePtr GetShape() const { return shape_; }
  unsigned int GetShapeType() const { return shape_ ? shape_->GetType() : static_cast<unsigned int>(SHAPE); }
  // What a plugin changes in it acts soon.
  SurfaceParamsPtr GetSurface() const;
  float GetLaserRetro() const { return 0.0f; }
  bool IsPlaceable() const { return !IsStatic(); }
  virtual ignition::math::Pose3d RelativePose() const { return initial_; }
  virtual ignition::math::Pose3d WorldPose() const;
  virtual ignition::math::Vector3d WorldLinearVel() const;
  virtual ignition::math::Vector3d WorldAngularVel() const;

 private:
  friend struct Builder;
  friend class World;
  // Add the name and values of a surface that has changed.
  void TakeChange(std::vector<std::string>& words, std::vector<double>& numbers) const;

  ShapePtr shape_;
  SurfaceParamsPtr surface_;
  mutable bool is_watched_ = false;
};

}  // namespace physics
}  // namespace gazebo

#endif
