#pragma once

#include <string>

#include <hardware_interface/internal/hardware_resource_manager.h>

namespace hardware_interface {

/** Orientation (x, y, z, w), angular velocity [rad/s] and linear acceleration [m/s²] of an IMU, with covariances of
   nine numbers; what the IMU does not measure is null. */
class ImuSensorHandle {
 public:
  struct Data {
    std::string name, frame_id;
    double* orientation = nullptr;
    double* orientation_covariance = nullptr;
    double* angular_velocity = nullptr;
    double* angular_velocity_covariance = nullptr;
    double* linear_acceleration = nullptr;
    double* linear_acceleration_covariance = nullptr;
  };

  ImuSensorHandle() {}
  ImuSensorHandle(const Data& data) : data_(data) {}

  std::string getName() const { return data_.name; }
  std::string getFrameId() const { return data_.frame_id; }
  const double* getOrientation() const { return data_.orientation; }
  const double* getOrientationCovariance() const { return data_.orientation_covariance; }
  const double* getAngularVelocity() const { return data_.angular_velocity; }
  const double* getAngularVelocityCovariance() const { return data_.angular_velocity_covariance; }
  const double* getLinearAcceleration() const { return data_.linear_acceleration; }
  const double* getLinearAccelerationCovariance() const { return data_.linear_acceleration_covariance; }

 private:
  Data data_;
};

class ImuSensorInterface : public HardwareResourceManager<ImuSensorHandle> {};

}  // namespace hardware_interface
