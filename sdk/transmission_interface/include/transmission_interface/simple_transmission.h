#pragma once

#include <cassert>

#include <transmission_interface/transmission.h>
#include <transmission_interface/transmission_interface_exception.h>

namespace transmission_interface {

/** One actuator and one joint: position of the joint = position of the actuator / reduction + offset. */
class SimpleTransmission : public Transmission {
 public:
  /** Throws TransmissionInterfaceException for a reduction of 0. */
  explicit SimpleTransmission(const double reduction, const double joint_offset = 0.0)
      : reduction_(reduction), offset_(joint_offset) {
    if (reduction == 0.0) throw TransmissionInterfaceException("Transmission reduction ratio cannot be zero.");
  }

  void actuatorToJointEffort(const ActuatorData& act, JointData& jnt) override {
    *at(jnt.effort) = *at(act.effort) * reduction_;
  }
  void actuatorToJointVelocity(const ActuatorData& act, JointData& jnt) override {
    *at(jnt.velocity) = *at(act.velocity) / reduction_;
  }
  void actuatorToJointPosition(const ActuatorData& act, JointData& jnt) override {
    *at(jnt.position) = *at(act.position) / reduction_ + offset_;
  }
  void actuatorToJointAbsolutePosition(const ActuatorData& act, JointData& jnt) override {
    *at(jnt.absolute_position) = *at(act.absolute_position) + offset_;
  }
  void actuatorToJointTorqueSensor(const ActuatorData& act, JointData& jnt) override {
    *at(jnt.torque_sensor) = *at(act.torque_sensor) * reduction_;
  }
  void jointToActuatorEffort(const JointData& jnt, ActuatorData& act) override {
    *at(act.effort) = *at(jnt.effort) / reduction_;
  }
  void jointToActuatorVelocity(const JointData& jnt, ActuatorData& act) override {
    *at(act.velocity) = *at(jnt.velocity) * reduction_;
  }
  void jointToActuatorPosition(const JointData& jnt, ActuatorData& act) override {
    *at(act.position) = (*at(jnt.position) - offset_) * reduction_;
  }
  bool hasActuatorToJointAbsolutePosition() const override { return true; }
  bool hasActuatorToJointTorqueSensor() const override { return true; }
  std::size_t numActuators() const override { return 1; }
  std::size_t numJoints() const override { return 1; }
  double getActuatorReduction() const { return reduction_; }
  double getJointOffset() const { return offset_; }

 private:
  static double* at(const std::vector<double*>& values) {
    assert(values.size() == 1 && values[0]);
    return values[0];
  }

  double reduction_, offset_;
};

}  // namespace transmission_interface
