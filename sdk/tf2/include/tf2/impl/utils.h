#pragma once

#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/QuaternionStamped.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include "tf2/LinearMath/Matrix3x3.h"

namespace tf2 {
namespace impl {
inline Quaternion toQuaternion(const Quaternion& q) { return q; }
inline Quaternion toQuaternion(const geometry_msgs::Quaternion& q) { return Quaternion(q.x, q.y, q.z, q.w); }
inline Quaternion toQuaternion(const geometry_msgs::QuaternionStamped& q) { return toQuaternion(q.quaternion); }
template <class T>
Quaternion toQuaternion(const Stamped<T>& t) {
  return toQuaternion(static_cast<const T&>(t));
}
/** Of any type that toMsg() makes a message of. */
template <class T>
Quaternion toQuaternion(const T& t) {
  return toQuaternion(toMsg(t));
}

/** Angles of a rotation about fixed axes [rad]. */
inline void getEulerYPR(const Quaternion& q, double& yaw, double& pitch, double& roll) {
  Matrix3x3(q).getEulerYPR(yaw, pitch, roll);
}
inline double getYaw(const Quaternion& q) {
  double yaw, pitch, roll;
  getEulerYPR(q, yaw, pitch, roll);
  return yaw;
}
}  // namespace impl

}  // namespace tf2
