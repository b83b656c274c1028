#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/QuaternionStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <tf2/convert.h>

namespace tf2 {

inline geometry_msgs::Vector3 toMsg(const Vector3& v) {
  geometry_msgs::Vector3 m;
  m.x = v.x();
  m.y = v.y();
  m.z = v.z();
  return m;
}
inline geometry_msgs::Point& toMsg(const Vector3& v, geometry_msgs::Point& m) {
  m.x = v.x();
  m.y = v.y();
  m.z = v.z();
  return m;
}
inline geometry_msgs::Quaternion toMsg(const Quaternion& q) {
  geometry_msgs::Quaternion m;
  m.x = q.x();
  m.y = q.y();
  m.z = q.z();
  m.w = q.w();
  return m;
}
inline geometry_msgs::Transform toMsg(const Transform& t) {
  geometry_msgs::Transform m;
  m.translation = toMsg(t.getOrigin());
  m.rotation = toMsg(t.getRotation());
  return m;
}
inline geometry_msgs::Pose& toMsg(const Transform& t, geometry_msgs::Pose& m) {
  toMsg(t.getOrigin(), m.position);
  m.orientation = toMsg(t.getRotation());
  return m;
}
inline geometry_msgs::TransformStamped toMsg(const Stamped<Transform>& t) {
  geometry_msgs::TransformStamped m;
  m.header.stamp = t.stamp_;
  m.header.frame_id = t.frame_id_;
  m.transform = toMsg(static_cast<const Transform&>(t));
  return m;
}
inline geometry_msgs::PoseStamped toMsg(const geometry_msgs::PoseStamped& m) { return m; }

inline void fromMsg(const geometry_msgs::Vector3& m, Vector3& v) { v.setValue(m.x, m.y, m.z); }
inline void fromMsg(const geometry_msgs::Point& m, Vector3& v) { v.setValue(m.x, m.y, m.z); }
inline void fromMsg(const geometry_msgs::Quaternion& m, Quaternion& q) { q.setValue(m.x, m.y, m.z, m.w); }
inline void fromMsg(const geometry_msgs::Transform& m, Transform& t) {
  t = Transform(Quaternion(m.rotation.x, m.rotation.y, m.rotation.z, m.rotation.w),
                Vector3(m.translation.x, m.translation.y, m.translation.z));
}
inline void fromMsg(const geometry_msgs::Pose& m, Transform& t) {
  t = Transform(Quaternion(m.orientation.x, m.orientation.y, m.orientation.z, m.orientation.w),
                Vector3(m.position.x, m.position.y, m.position.z));
}
inline void fromMsg(const geometry_msgs::TransformStamped& m, Stamped<Transform>& t) {
  t.stamp_ = m.header.stamp;
  t.frame_id_ = m.header.frame_id;
  fromMsg(m.transform, static_cast<Transform&>(t));
}
inline void fromMsg(const geometry_msgs::PoseStamped& m, Stamped<Transform>& t) {
  t.stamp_ = m.header.stamp;
  t.frame_id_ = m.header.frame_id;
  fromMsg(m.pose, static_cast<Transform&>(t));
}

namespace impl {
inline Transform transformOf(const geometry_msgs::TransformStamped& m) {
  Transform t;
  fromMsg(m.transform, t);
  return t;
}
}  // namespace impl

template <>
inline void doTransform(const geometry_msgs::Point& in, geometry_msgs::Point& out,
                        const geometry_msgs::TransformStamped& transform) {
  toMsg(impl::transformOf(transform) * Vector3(in.x, in.y, in.z), out);
}
template <>
inline void doTransform(const geometry_msgs::Vector3& in, geometry_msgs::Vector3& out,
                        const geometry_msgs::TransformStamped& transform) {
  out = toMsg(impl::transformOf(transform).getBasis() * Vector3(in.x, in.y, in.z));
}
template <>
inline void doTransform(const geometry_msgs::Quaternion& in, geometry_msgs::Quaternion& out,
                        const geometry_msgs::TransformStamped& transform) {
  Quaternion q;
  fromMsg(in, q);
  out = toMsg(impl::transformOf(transform) * q);
}
template <>
inline void doTransform(const geometry_msgs::Pose& in, geometry_msgs::Pose& out,
                        const geometry_msgs::TransformStamped& transform) {
  Transform pose;
  fromMsg(in, pose);
  toMsg(impl::transformOf(transform) * pose, out);
}
#define TF2_STAMPED(Type, field)                                                   \
  template <>                                                                      \
  inline void doTransform(const geometry_msgs::Type& in, geometry_msgs::Type& out, \
                          const geometry_msgs::TransformStamped& transform) {      \
    doTransform(in.field, out.field, transform);                                   \
    out.header.stamp = transform.header.stamp;                                     \
    out.header.frame_id = transform.header.frame_id;                               \
  }
TF2_STAMPED(PointStamped, point)
TF2_STAMPED(Vector3Stamped, vector)
TF2_STAMPED(QuaternionStamped, quaternion)
TF2_STAMPED(PoseStamped, pose)
#undef TF2_STAMPED

}  // namespace tf2
