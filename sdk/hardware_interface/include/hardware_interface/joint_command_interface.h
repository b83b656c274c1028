#pragma once

#include <cassert>
#include <string>

#include <hardware_interface/internal/hardware_resource_manager.h>
#include <hardware_interface/joint_state_interface.h>

namespace hardware_interface {

/** State of a joint, and one number that commands it. */
class JointHandle : public JointStateHandle {
 public:
  JointHandle() {}
  /** Throws HardwareInterfaceException if `cmd` is null. */
  JointHandle(const JointStateHandle& js, double* cmd) : JointStateHandle(js), cmd_(cmd) {
    if (!cmd)
      throw HardwareInterfaceException("Cannot create handle '" + js.getName() + "'. Command data pointer is null.");
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

/** Joints with commands, each claimed by one controller. */
class JointCommandInterface : public HardwareResourceManager<JointHandle, ClaimResources> {};
/** [N·m or N] */
class EffortJointInterface : public JointCommandInterface {};
/** [rad/s or m/s] */
class VelocityJointInterface : public JointCommandInterface {};
/** [rad or m] */
class PositionJointInterface : public JointCommandInterface {};

}  // namespace hardware_interface
