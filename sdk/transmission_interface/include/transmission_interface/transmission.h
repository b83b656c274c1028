#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace transmission_interface {

/** Numbers of actuators, one address each; those of the other kind may be empty. */
struct ActuatorData {
  std::vector<double*> position, velocity, effort, absolute_position, torque_sensor;
};
/** Numbers of joints. */
struct JointData {
  std::vector<double*> position, velocity, effort, absolute_position, torque_sensor;
};

/** Relation of actuators and joints. */
class Transmission {
 public:
  virtual ~Transmission() {}
  virtual void actuatorToJointEffort(const ActuatorData& act_data, JointData& jnt_data) = 0;
  virtual void actuatorToJointVelocity(const ActuatorData& act_data, JointData& jnt_data) = 0;
  virtual void actuatorToJointPosition(const ActuatorData& act_data, JointData& jnt_data) = 0;
  virtual void jointToActuatorEffort(const JointData& jnt_data, ActuatorData& act_data) = 0;
  virtual void jointToActuatorVelocity(const JointData& jnt_data, ActuatorData& act_data) = 0;
  virtual void jointToActuatorPosition(const JointData& jnt_data, ActuatorData& act_data) = 0;
  virtual void actuatorToJointAbsolutePosition(const ActuatorData&, JointData&) {}
  virtual void actuatorToJointTorqueSensor(const ActuatorData&, JointData&) {}
  virtual bool hasActuatorToJointAbsolutePosition() const { return false; }
  virtual bool hasActuatorToJointTorqueSensor() const { return false; }
  virtual std::size_t numActuators() const = 0;
  virtual std::size_t numJoints() const = 0;
};
typedef std::shared_ptr<Transmission> TransmissionSharedPtr;

}  // namespace transmission_interface
