#pragma once

#include <transmission_interface/pair_transmission.h>

namespace transmission_interface {

/** Differential gear: the first joint turns by the mean of both actuators, the second by half of their difference. */
class DifferentialTransmission : public PairTransmission {
 public:
  DifferentialTransmission(const std::vector<double>& actuator_reduction, const std::vector<double>& joint_reduction,
                           const std::vector<double>& joint_offset = std::vector<double>(2, 0.0))
      : PairTransmission(actuator_reduction, joint_reduction, joint_offset) {
    const double a0 = 2.0 * act_reduction_[0], a1 = 2.0 * act_reduction_[1];
    setMatrix(1.0 / (jnt_reduction_[0] * a0), 1.0 / (jnt_reduction_[0] * a1), 1.0 / (jnt_reduction_[1] * a0),
              -1.0 / (jnt_reduction_[1] * a1));
  }
};

}  // namespace transmission_interface
