#pragma once

#include <hardware_interface/joint_state_interface.h>

namespace hardware_interface {

/** State of a motor, as of a joint. */
class ActuatorStateHandle : public JointStateHandle {
 public:
  using JointStateHandle::JointStateHandle;
  ActuatorStateHandle() {}
};

class ActuatorStateInterface : public HardwareResourceManager<ActuatorStateHandle> {};

}  // namespace hardware_interface
