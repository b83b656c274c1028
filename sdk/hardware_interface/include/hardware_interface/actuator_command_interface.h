#pragma once

#include <cassert>

#include <hardware_interface/actuator_state_interface.h>

namespace hardware_interface {

/** State of a motor, and one number that commands it. */
class ActuatorHandle : public ActuatorStateHandle {
 public:
  ActuatorHandle() {}
  /** Throws HardwareInterfaceException if `cmd` is null. */
  ActuatorHandle(const ActuatorStateHandle& as, double* cmd) : ActuatorStateHandle(as), cmd_(cmd) {
    if (!cmd) throw HardwareInterfaceException("Cannot create handle '" + as.getName() + "'. Command pointer is null.");
  }

  void setCommand(double command) {
    assert(cmd_);
    *cmd_ = command;
  }
  double getCommand() const {
    assert(cmd_);
    return *cmd_;
  }
  const double* getCommandPtr() const { return cmd_; }

 private:
  double* cmd_ = nullptr;
};

class ActuatorCommandInterface : public HardwareResourceManager<ActuatorHandle, ClaimResources> {};
class EffortActuatorInterface : public ActuatorCommandInterface {};
class VelocityActuatorInterface : public ActuatorCommandInterface {};
class PositionActuatorInterface : public ActuatorCommandInterface {};

}  // namespace hardware_interface
