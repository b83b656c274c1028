#ifndef GAZEBO_SENSORS_IMUSENSOR_HH_
#define GAZEBO_SENSORS_IMUSENSOR_HH_

#include <gazebo/sensors/Sensor.hh>

namespace gazebo {
namespace sensors {

// Noise of the file is in both kinds of values; [rad/s], [m/s²], in the sensor's frame.
class ImuSensor : public Sensor {
 public:
  ImuSensor() : Sensor(OTHER) {}

  // Against the reference: the sensor's first pose, or what the file says.
  ignition::math::Quaterniond Orientation() const { return Locked(orientation_); }
  ignition::math::Vector3d AngularVelocity(bool = false) const { return Locked(angular_velocity_); }
  ignition::math::Vector3d LinearAcceleration(bool = false) const { return Locked(acceleration_); }

  // Orientations are against this one from now on.
  void SetWorldToReferenceOrientation(const ignition::math::Quaterniond& orientation) {
    const std::lock_guard<std::mutex> lock(mutex_);
    reference_ = orientation;
    has_reference_ = true;
  }
  void SetReferencePose();

  // Names up to Gazebo 6.
  math::Quaternion GetOrientation() const { return Orientation(); }
  math::Vector3 GetAngularVelocity() const { return AngularVelocity(); }
  math::Vector3 GetLinearAcceleration() const { return LinearAcceleration(); }

 protected:
  void Set(const TrundleGazeboReading& reading) override;

 private:
  template <typename T>
  T Locked(const T& value) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return value;
  }

  friend class SensorManager;
  ignition::math::Quaterniond WorldRotation() const;

  physics::LinkPtr link_;
  bool has_reference_ = false;
  ignition::math::Quaterniond orientation_, reference_;
  ignition::math::Vector3d angular_velocity_, acceleration_;
};

}  // namespace sensors
}  // namespace gazebo

#endif
