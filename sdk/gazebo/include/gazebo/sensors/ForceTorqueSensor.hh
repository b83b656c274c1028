#ifndef GAZEBO_SENSORS_FORCETORQUESENSOR_HH_
#define GAZEBO_SENSORS_FORCETORQUESENSOR_HH_

#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/Joint.hh>
#include <gazebo/sensors/Sensor.hh>

namespace gazebo {
namespace sensors {

// Force and torque at a joint [N], [N·m], in the frame that the file says.
class ForceTorqueSensor : public Sensor {
 public:
  ForceTorqueSensor() : Sensor(OTHER) {}

  physics::JointPtr Joint() const { return joint_; }
  ignition::math::Vector3d Force() const { return Locked(force_); }
  ignition::math::Vector3d Torque() const { return Locked(torque_); }
  event::ConnectionPtr ConnectUpdate(std::function<void(msgs::WrenchStamped)> subscriber) {
    return new_wrenches_.Connect(subscriber);
  }
  void DisconnectUpdate(event::ConnectionPtr connection) { new_wrenches_.Disconnect(connection); }
  bool IsWanted() const override { return Sensor::IsWanted() || new_wrenches_.ConnectionCount() > 0; }
  physics::JointPtr GetJoint() const { return joint_; }
  math::Vector3 GetForce() const { return Force(); }
  math::Vector3 GetTorque() const { return Torque(); }

 protected:
  void Set(const TrundleGazeboReading& reading) override;
  void Tell(const void* world) override;

 private:
  friend class SensorManager;
  ignition::math::Vector3d Locked(const ignition::math::Vector3d& value) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return value;
  }
  physics::JointPtr joint_;
  ignition::math::Vector3d force_, torque_;
  event::EventT<void(msgs::WrenchStamped)> new_wrenches_;
};

}  // namespace sensors
}  // namespace gazebo

#endif
