#pragma once

#include <string>

#include <hardware_interface/internal/hardware_resource_manager.h>

namespace hardware_interface {

/** Force [N] and torque [N·m] of a sensor, three numbers each, in its frame. */
class ForceTorqueSensorHandle {
 public:
  ForceTorqueSensorHandle() {}
  ForceTorqueSensorHandle(const std::string& name, const std::string& frame_id, const double* force,
                          const double* torque)
      : name_(name), frame_id_(frame_id), force_(force), torque_(torque) {}

  std::string getName() const { return name_; }
  std::string getFrameId() const { return frame_id_; }
  const double* getForce() const { return force_; }
  const double* getTorque() const { return torque_; }

 private:
  std::string name_, frame_id_;
  const double *force_ = nullptr, *torque_ = nullptr;
};

class ForceTorqueSensorInterface : public HardwareResourceManager<ForceTorqueSensorHandle> {};

}  // namespace hardware_interface
