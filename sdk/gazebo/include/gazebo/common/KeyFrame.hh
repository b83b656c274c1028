// Values at the time of an animation [s].
#ifndef GAZEBO_COMMON_KEYFRAME_HH_
#define GAZEBO_COMMON_KEYFRAME_HH_

#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/math/Quaternion.hh>
#include <gazebo/math/Vector3.hh>

namespace gazebo {
namespace common {

class KeyFrame {
 public:
  explicit KeyFrame(double time) : time_(time) {}
  virtual ~KeyFrame() {}
  double GetTime() const { return time_; }

 protected:
  double time_;
};

// Pose in the world.
class PoseKeyFrame : public KeyFrame {
 public:
  explicit PoseKeyFrame(double time) : KeyFrame(time) {}
  void Translation(const ignition::math::Vector3d& position) { position_ = position; }
  ignition::math::Vector3d Translation() const { return position_; }
  void Rotation(const ignition::math::Quaterniond& rotation) { rotation_ = rotation; }
  ignition::math::Quaterniond Rotation() const { return rotation_; }

  // Names up to Gazebo 7.
  void SetTranslation(const math::Vector3& position) { position_ = position.Ign(); }
  math::Vector3 GetTranslation() const { return position_; }
  void SetRotation(const math::Quaternion& rotation) { rotation_ = rotation.Ign(); }
  math::Quaternion GetRotation() const { return rotation_; }

 private:
  ignition::math::Vector3d position_;
  ignition::math::Quaterniond rotation_;
};

// Position of a joint [rad or m].
class NumericKeyFrame : public KeyFrame {
 public:
  explicit NumericKeyFrame(double time) : KeyFrame(time) {}
  void SetValue(const double& value) { value_ = value; }
  const double& GetValue() const { return value_; }

 private:
  double value_ = 0.0;
};

}  // namespace common
}  // namespace gazebo

#endif
