#pragma once

#include <string>

#include <hardware_interface/internal/hardware_resource_manager.h>

namespace hardware_interface {

/** How a joint is commanded. */
enum class JointCommandModes {
  BEGIN = -1,
  MODE_POSITION = 0,
  MODE_VELOCITY = 1,
  MODE_EFFORT = 2,
  NOMODE = 3,
  EMERGENCY_STOP = 4,
  SWITCHING = 5,
  ERROR = 6
};

class JointModeHandle {
 public:
  JointModeHandle() {}
  /** Throws HardwareInterfaceException if `mode` is null. */
  JointModeHandle(std::string name, JointCommandModes* mode) : name_(name), mode_(mode) {
    if (!mode) throw HardwareInterfaceException("Cannot create mode interface. Mode data pointer is null.");
  }

  std::string getName() const { return name_; }
  void setMode(JointCommandModes mode) { *mode_ = mode; }
  JointCommandModes getMode() const { return *mode_; }
  std::string getModeName(JointCommandModes mode) const {
    switch (mode) {
      case JointCommandModes::BEGIN: return "not_operational";
      case JointCommandModes::MODE_POSITION: return "position";
      case JointCommandModes::MODE_VELOCITY: return "velocity";
      case JointCommandModes::MODE_EFFORT: return "effort";
      case JointCommandModes::EMERGENCY_STOP: return "emergency_stop";
      case JointCommandModes::SWITCHING: return "switching";
      case JointCommandModes::ERROR: return "error";
      default: return "unknown";
    }
  }

 private:
  std::string name_;
  JointCommandModes* mode_ = nullptr;
};

class JointModeInterface : public HardwareResourceManager<JointModeHandle, ClaimResources> {};

}  // namespace hardware_interface
