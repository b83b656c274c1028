#pragma once

#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/QuaternionStamped.h>

#include "tf2/LinearMath/Matrix3x3.h"

namespace tf2 {
namespace impl {
inline Quaternion quaternionOf(const Quaternion& q) { return q; }
inline Quaternion quaternionOf(const geometry_msgs::Quaternion& q) { return Quaternion(q.x, q.y, q.z, q.w); }
inline Quaternion quaternionOf(const geometry_msgs::QuaternionStamped& q) { return quaternionOf(q.quaternion); }
}  // namespace impl

}  // namespace tf2
