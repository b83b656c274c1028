#pragma once

#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/QuaternionStamped.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <cmath>

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
/** Angle about z [rad]; 0 of a quaternion of zeros, as in tf2. */
inline double getYaw(const Quaternion& q) {
  const double xx = q.x() * q.x(), yy = q.y() * q.y(), zz = q.z() * q.z(), ww = q.w() * q.w();
  const double sine = -2 * (q.x() * q.z() - q.w() * q.y()) / (xx + yy + zz + ww);
  if (sine <= -0.99999) return -2 * std::atan2(q.y(), q.x());
  if (sine >= 0.99999) return 2 * std::atan2(q.y(), q.x());
  return std::atan2(2 * (q.x() * q.y() + q.w() * q.z()), ww + xx - yy - zz);
}
}  // namespace impl

}  // namespace tf2
