#pragma once

#include <cassert>
#include <string>

#include <hardware_interface/internal/hardware_resource_manager.h>
#include <hardware_interface/joint_state_interface.h>

namespace hardware_interface {

/** Joint that is commanded by a position and a velocity. */
class PosVelJointHandle : public JointStateHandle {
 public:
  PosVelJointHandle() {}
  /** Throws HardwareInterfaceException if a pointer is null. */
  PosVelJointHandle(const JointStateHandle& js, double* cmd_pos, double* cmd_vel)
      : JointStateHandle(js), cmd_pos_(cmd_pos), cmd_vel_(cmd_vel) {
    if (!cmd_pos || !cmd_vel)
      throw HardwareInterfaceException("Cannot create handle '" + js.getName() + "'. Command data pointer is null.");
  }

  void setCommand(double cmd_pos, double cmd_vel) {
    setCommandPosition(cmd_pos);
    setCommandVelocity(cmd_vel);
  }
  void setCommandPosition(double cmd_pos) {
    assert(cmd_pos_);
    *cmd_pos_ = cmd_pos;
  }
  void setCommandVelocity(double cmd_vel) {
    assert(cmd_vel_);
    *cmd_vel_ = cmd_vel;
  }
  double getCommandPosition() const { return *cmd_pos_; }
  double getCommandVelocity() const { return *cmd_vel_; }
  const double* getCommandPositionPtr() const { return cmd_pos_; }
  const double* getCommandVelocityPtr() const { return cmd_vel_; }

 private:
  double *cmd_pos_ = nullptr, *cmd_vel_ = nullptr;
};

class PosVelJointInterface : public HardwareResourceManager<PosVelJointHandle, ClaimResources> {};

}  // namespace hardware_interface
