#pragma once

#include <transmission_interface/pair_transmission.h>

namespace transmission_interface {

/** Four-bar linkage: the first joint turns with the first actuator, which the second one's position is relative to. */
class FourBarLinkageTransmission : public PairTransmission {
 public:
  FourBarLinkageTransmission(const std::vector<double>& actuator_reduction, const std::vector<double>& joint_reduction,
                             const std::vector<double>& joint_offset = std::vector<double>(2, 0.0))
      : PairTransmission(actuator_reduction, joint_reduction, joint_offset) {
    const double first = 1.0 / (jnt_reduction_[0] * act_reduction_[0]);
    setMatrix(first, 0.0, -first / jnt_reduction_[1], 1.0 / (jnt_reduction_[1] * act_reduction_[1]));
  }

  /** Efforts by the original's formula, which leaves out the work that the second actuator does on the first joint. */
  void actuatorToJointEffort(const ActuatorData& act, JointData& jnt) override {
    const double first = *act.effort[0] * act_reduction_[0] * jnt_reduction_[0];
    *jnt.effort[0] = first;
    *jnt.effort[1] = jnt_reduction_[1] * (*act.effort[1] * act_reduction_[1] - first);
  }
  void jointToActuatorEffort(const JointData& jnt, ActuatorData& act) override {
    *act.effort[0] = *jnt.effort[0] / (act_reduction_[0] * jnt_reduction_[0]);
    *act.effort[1] = (*jnt.effort[0] + *jnt.effort[1] / jnt_reduction_[1]) / act_reduction_[1];
  }
};

}  // namespace transmission_interface
