#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2/LinearMath/Transform.h>
#include <tf2/convert.h>

namespace tf2 {

inline sensor_msgs::PointCloud2 toMsg(const sensor_msgs::PointCloud2& in) { return in; }
inline void fromMsg(const sensor_msgs::PointCloud2& m, sensor_msgs::PointCloud2& out) { out = m; }

/** Move the points x, y, z of a cloud. Throws std::runtime_error if it has no such fields. */
template <>
inline void doTransform(const sensor_msgs::PointCloud2& in, sensor_msgs::PointCloud2& out,
                        const geometry_msgs::TransformStamped& transform) {
  const geometry_msgs::Transform& m = transform.transform;
  const Transform t(Quaternion(m.rotation.x, m.rotation.y, m.rotation.z, m.rotation.w),
                    Vector3(m.translation.x, m.translation.y, m.translation.z));
  if (&in != &out) out = in;
  out.header = transform.header;
  sensor_msgs::PointCloud2Iterator<float> x(out, "x"), y(out, "y"), z(out, "z");
  for (; x != x.end(); ++x, ++y, ++z) {
    const Vector3 moved = t * Vector3(*x, *y, *z);
    *x = static_cast<float>(moved.x());
    *y = static_cast<float>(moved.y());
    *z = static_cast<float>(moved.z());
  }
}

}  // namespace tf2
