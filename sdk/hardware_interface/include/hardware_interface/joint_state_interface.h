#pragma once

#include <cassert>
#include <string>

#include <hardware_interface/internal/hardware_resource_manager.h>

namespace hardware_interface {

/** Position, velocity and effort of a joint, where its hardware keeps them; in some robots an absolute position and the
    effort of a torque sensor, too. */
class JointStateHandle {
 public:
  JointStateHandle() {}
  /** Throws HardwareInterfaceException if a pointer is null. */
  JointStateHandle(const std::string& name, const double* pos, const double* vel, const double* eff)
      : name_(name), pos_(pos), vel_(vel), eff_(eff) {
    require(pos, "Position");
    require(vel, "Velocity");
    require(eff, "Effort");
  }
  JointStateHandle(const std::string& name, const double* pos, const double* vel, const double* eff,
                   const double* absolute_pos)
      : JointStateHandle(name, pos, vel, eff) {
    require(absolute_pos, "Absolute position");
    absolute_pos_ = absolute_pos;
  }
  JointStateHandle(const std::string& name, const double* pos, const double* vel, const double* eff,
                   const double* absolute_pos, const double* torque_sensor)
      : JointStateHandle(name, pos, vel, eff, absolute_pos) {
    require(torque_sensor, "Torque sensor");
    torque_sensor_ = torque_sensor;
  }
  JointStateHandle(const std::string& name, const double* pos, const double* vel, const double* eff,
                   const double* torque_sensor, bool)
      : JointStateHandle(name, pos, vel, eff) {
    require(torque_sensor, "Torque sensor");
    torque_sensor_ = torque_sensor;
  }

  std::string getName() const { return name_; }
  double getPosition() const { return *known(pos_); }
  double getVelocity() const { return *known(vel_); }
  double getEffort() const { return *known(eff_); }
  double getAbsolutePosition() const { return *optional(absolute_pos_, "absolute position"); }
  double getTorqueSensor() const { return *optional(torque_sensor_, "torque sensor"); }
  const double* getPositionPtr() const { return pos_; }
  const double* getVelocityPtr() const { return vel_; }
  const double* getEffortPtr() const { return eff_; }
  const double* getAbsolutePositionPtr() const { return optional(absolute_pos_, "absolute position"); }
  const double* getTorqueSensorPtr() const { return optional(torque_sensor_, "torque sensor"); }
  bool hasAbsolutePosition() const { return absolute_pos_ != nullptr; }
  bool hasTorqueSensor() const { return torque_sensor_ != nullptr; }

 private:
  void require(const double* data, const char* what) const {
    if (!data)
      throw HardwareInterfaceException("Cannot create handle '" + name_ + "'. " + what + " data pointer is null.");
  }
  static const double* known(const double* data) {
    assert(data);
    return data;
  }
  static const double* optional(const double* data, const char* what) {
    if (!data) throw std::runtime_error(std::string("this joint has no ") + what);
    return data;
  }

  std::string name_;
  const double *pos_ = nullptr, *vel_ = nullptr, *eff_ = nullptr;
  const double *absolute_pos_ = nullptr, *torque_sensor_ = nullptr;
};

class JointStateInterface : public HardwareResourceManager<JointStateHandle> {};

}  // namespace hardware_interface
