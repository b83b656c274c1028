#pragma once

#include "tf2/impl/utils.h"

namespace tf2 {

/** Angles of a rotation about fixed axes [rad]. */
template <class A>
void getEulerYPR(const A& a, double& yaw, double& pitch, double& roll) {
  Matrix3x3(impl::quaternionOf(a)).getEulerYPR(yaw, pitch, roll);
}
template <class A>
double getYaw(const A& a) {
  double yaw, pitch, roll;
  getEulerYPR(a, yaw, pitch, roll);
  return yaw;
}

}  // namespace tf2
