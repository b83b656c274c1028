#pragma once

#include <hardware_interface/posvel_command_interface.h>

namespace hardware_interface {

/** Joint that is commanded by a position, a velocity and an acceleration. */
class PosVelAccJointHandle : public PosVelJointHandle {
 public:
  PosVelAccJointHandle() {}
  /** Throws HardwareInterfaceException if a pointer is null. */
  PosVelAccJointHandle(const JointStateHandle& js, double* cmd_pos, double* cmd_vel, double* cmd_acc)
      : PosVelJointHandle(js, cmd_pos, cmd_vel), cmd_acc_(cmd_acc) {
    if (!cmd_acc)
      throw HardwareInterfaceException("Cannot create handle '" + js.getName() + "'. Command data pointer is null.");
  }

  void setCommand(double cmd_pos, double cmd_vel, double cmd_acc) {
    PosVelJointHandle::setCommand(cmd_pos, cmd_vel);
    setCommandAcceleration(cmd_acc);
  }
  void setCommandAcceleration(double cmd_acc) {
    assert(cmd_acc_);
    *cmd_acc_ = cmd_acc;
  }
  double getCommandAcceleration() const { return *cmd_acc_; }
  const double* getCommandAccelerationPtr() const { return cmd_acc_; }

 private:
  double* cmd_acc_ = nullptr;
};

class PosVelAccJointInterface : public HardwareResourceManager<PosVelAccJointHandle, ClaimResources> {};

}  // namespace hardware_interface
