#pragma once

#include <LinearMath/btTransform.h>
#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <tf2/convert.h>

namespace tf2 {

inline btTransform transformToBullet(const geometry_msgs::TransformStamped& t) {
  const geometry_msgs::Transform& m = t.transform;
  const auto scalar = [](double value) { return static_cast<btScalar>(value); };
  return btTransform(
      btQuaternion(scalar(m.rotation.x), scalar(m.rotation.y), scalar(m.rotation.z), scalar(m.rotation.w)),
      btVector3(scalar(m.translation.x), scalar(m.translation.y), scalar(m.translation.z)));
}

template <>
inline void doTransform(const tf2::Stamped<btVector3>& in, tf2::Stamped<btVector3>& out,
                        const geometry_msgs::TransformStamped& transform) {
  out = tf2::Stamped<btVector3>(transformToBullet(transform) * in, transform.header.stamp, transform.header.frame_id);
}
inline geometry_msgs::PointStamped toMsg(const tf2::Stamped<btVector3>& in) {
  geometry_msgs::PointStamped m;
  m.header.stamp = in.stamp_;
  m.header.frame_id = in.frame_id_;
  m.point.x = in.x();
  m.point.y = in.y();
  m.point.z = in.z();
  return m;
}
inline void fromMsg(const geometry_msgs::PointStamped& m, tf2::Stamped<btVector3>& out) {
  out.stamp_ = m.header.stamp;
  out.frame_id_ = m.header.frame_id;
  out.setValue(static_cast<btScalar>(m.point.x), static_cast<btScalar>(m.point.y), static_cast<btScalar>(m.point.z));
}

template <>
inline void doTransform(const tf2::Stamped<btTransform>& in, tf2::Stamped<btTransform>& out,
                        const geometry_msgs::TransformStamped& transform) {
  out = tf2::Stamped<btTransform>(transformToBullet(transform) * in, transform.header.stamp, transform.header.frame_id);
}

}  // namespace tf2
