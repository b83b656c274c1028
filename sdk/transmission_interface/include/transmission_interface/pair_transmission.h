#pragma once

#include <cassert>
#include <string>

#include <transmission_interface/transmission.h>
#include <transmission_interface/transmission_interface_exception.h>

namespace transmission_interface {

/** Two actuators and two joints, whose velocities depend linearly on each other. */
class PairTransmission : public Transmission {
 public:
  void actuatorToJointEffort(const ActuatorData& act, JointData& jnt) override {
    const double a0 = value(act.effort, 0), a1 = value(act.effort, 1);  // by the transpose of joint to actuator speeds
    *jnt.effort[0] = back_[0][0] * a0 + back_[1][0] * a1;
    *jnt.effort[1] = back_[0][1] * a0 + back_[1][1] * a1;
  }
  void actuatorToJointVelocity(const ActuatorData& act, JointData& jnt) override {
    multiply(forth_, value(act.velocity, 0), value(act.velocity, 1), jnt.velocity, 0.0, 0.0);
  }
  void actuatorToJointPosition(const ActuatorData& act, JointData& jnt) override {
    multiply(forth_, value(act.position, 0), value(act.position, 1), jnt.position, offset_[0], offset_[1]);
  }
  void jointToActuatorEffort(const JointData& jnt, ActuatorData& act) override {
    const double j0 = value(jnt.effort, 0), j1 = value(jnt.effort, 1);
    *act.effort[0] = forth_[0][0] * j0 + forth_[1][0] * j1;
    *act.effort[1] = forth_[0][1] * j0 + forth_[1][1] * j1;
  }
  void jointToActuatorVelocity(const JointData& jnt, ActuatorData& act) override {
    multiply(back_, value(jnt.velocity, 0), value(jnt.velocity, 1), act.velocity, 0.0, 0.0);
  }
  void jointToActuatorPosition(const JointData& jnt, ActuatorData& act) override {
    multiply(back_, value(jnt.position, 0) - offset_[0], value(jnt.position, 1) - offset_[1], act.position, 0.0, 0.0);
  }
  std::size_t numActuators() const override { return 2; }
  std::size_t numJoints() const override { return 2; }
  const std::vector<double>& getActuatorReduction() const { return act_reduction_; }
  const std::vector<double>& getJointReduction() const { return jnt_reduction_; }
  const std::vector<double>& getJointOffset() const { return offset_; }

 protected:
  PairTransmission(const std::vector<double>& actuator_reduction, const std::vector<double>& joint_reduction,
                   const std::vector<double>& joint_offset)
      : act_reduction_(actuator_reduction), jnt_reduction_(joint_reduction), offset_(joint_offset) {
    if (act_reduction_.size() != 2 || jnt_reduction_.size() != 2 || offset_.size() != 2)
      throw TransmissionInterfaceException("Reduction and offset vectors must have size 2.");
    for (const double reduction : {act_reduction_[0], act_reduction_[1], jnt_reduction_[0], jnt_reduction_[1]})
      if (reduction == 0.0) throw TransmissionInterfaceException("Transmission reduction ratios cannot be zero.");
  }

  /** Set the matrix of joint velocities from actuator velocities, and its inverse. */
  void setMatrix(double m00, double m01, double m10, double m11) {
    const double determinant = m00 * m11 - m01 * m10;
    forth_[0][0] = m00, forth_[0][1] = m01, forth_[1][0] = m10, forth_[1][1] = m11;
    back_[0][0] = m11 / determinant, back_[0][1] = -m01 / determinant;
    back_[1][0] = -m10 / determinant, back_[1][1] = m00 / determinant;
  }

  std::vector<double> act_reduction_, jnt_reduction_, offset_;

 private:
  static double value(const std::vector<double*>& values, std::size_t index) {
    assert(values.size() == 2 && values[index]);
    return *values[index];
  }
  static void multiply(const double (&matrix)[2][2], double x, double y, const std::vector<double*>& out, double add0,
                       double add1) {
    *out[0] = matrix[0][0] * x + matrix[0][1] * y + add0;
    *out[1] = matrix[1][0] * x + matrix[1][1] * y + add1;
  }

  double forth_[2][2] = {}, back_[2][2] = {};
};

}  // namespace transmission_interface
