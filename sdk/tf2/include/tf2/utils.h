#pragma once

#include "tf2/impl/utils.h"

namespace tf2 {

/** Angles of a rotation about fixed axes [rad]. */
template <class A>
void getEulerYPR(const A& a, double& yaw, double& pitch, double& roll) {
  impl::getEulerYPR(impl::toQuaternion(a), yaw, pitch, roll);
}
template <class A>
double getYaw(const A& a) {
  return impl::getYaw(impl::toQuaternion(a));
}
/** The identity as a value of type A. */
template <class A>
A getTransformIdentity() {
  Transform t;
  t.setIdentity();
  A a;
  convert(t, a);
  return a;
}

}  // namespace tf2
