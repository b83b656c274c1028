#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/QuaternionStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <tf2/convert.h>

#include <boost/array.hpp>

namespace tf2 {

// Messages are converted to themselves.
#define TF2_SAME(Type)                                                         \
  inline geometry_msgs::Type toMsg(const geometry_msgs::Type& m) { return m; } \
  inline void fromMsg(const geometry_msgs::Type& m, geometry_msgs::Type& out) { out = m; }
TF2_SAME(Point)
TF2_SAME(PointStamped)
TF2_SAME(Pose)
TF2_SAME(PoseStamped)
TF2_SAME(PoseWithCovarianceStamped)
TF2_SAME(Quaternion)
TF2_SAME(QuaternionStamped)
TF2_SAME(Transform)
TF2_SAME(TransformStamped)
TF2_SAME(Vector3)
TF2_SAME(Vector3Stamped)
TF2_SAME(Wrench)
TF2_SAME(WrenchStamped)
#undef TF2_SAME

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
namespace impl {
/** Copy stamp and frame of a stamped value into a message, or back. */
template <class T, class M>
M& withHeader(const Stamped<T>& value, M& m) {
  m.header.stamp = value.stamp_;
  m.header.frame_id = value.frame_id_;
  return m;
}
template <class M, class T>
void takeHeader(const M& m, Stamped<T>& value) {
  value.stamp_ = m.header.stamp;
  value.frame_id_ = m.header.frame_id;
}
}  // namespace impl
inline geometry_msgs::TransformStamped toMsg(const Stamped<Transform>& t) {
  geometry_msgs::TransformStamped m;
  m.transform = toMsg(static_cast<const Transform&>(t));
  return impl::withHeader(t, m);
}
inline geometry_msgs::PointStamped toMsg(const Stamped<Vector3>& v, geometry_msgs::PointStamped& m) {
  toMsg(static_cast<const Vector3&>(v), m.point);
  return impl::withHeader(v, m);
}
inline geometry_msgs::Vector3Stamped toMsg(const Stamped<Vector3>& v) {
  geometry_msgs::Vector3Stamped m;
  m.vector = toMsg(static_cast<const Vector3&>(v));
  return impl::withHeader(v, m);
}
inline geometry_msgs::QuaternionStamped toMsg(const Stamped<Quaternion>& q) {
  geometry_msgs::QuaternionStamped m;
  m.quaternion = toMsg(static_cast<const Quaternion&>(q));
  return impl::withHeader(q, m);
}
inline geometry_msgs::PoseStamped toMsg(const Stamped<Transform>& t, geometry_msgs::PoseStamped& m) {
  toMsg(static_cast<const Transform&>(t), m.pose);
  return impl::withHeader(t, m);
}

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
  impl::takeHeader(m, t);
  fromMsg(m.transform, static_cast<Transform&>(t));
}
inline void fromMsg(const geometry_msgs::PoseStamped& m, Stamped<Transform>& t) {
  impl::takeHeader(m, t);
  fromMsg(m.pose, static_cast<Transform&>(t));
}
inline void fromMsg(const geometry_msgs::PoseWithCovarianceStamped& m, Stamped<Transform>& t) {
  impl::takeHeader(m, t);
  fromMsg(m.pose.pose, static_cast<Transform&>(t));
}
inline void fromMsg(const geometry_msgs::PointStamped& m, Stamped<Vector3>& v) {
  impl::takeHeader(m, v);
  fromMsg(m.point, static_cast<Vector3&>(v));
}
inline void fromMsg(const geometry_msgs::Vector3Stamped& m, Stamped<Vector3>& v) {
  impl::takeHeader(m, v);
  fromMsg(m.vector, static_cast<Vector3&>(v));
}
inline void fromMsg(const geometry_msgs::QuaternionStamped& m, Stamped<Quaternion>& q) {
  impl::takeHeader(m, q);
  fromMsg(m.quaternion, static_cast<Quaternion&>(q));
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
template <>
inline void doTransform(const geometry_msgs::Transform& in, geometry_msgs::Transform& out,
                        const geometry_msgs::TransformStamped& transform) {
  Transform t;
  fromMsg(in, t);
  out = toMsg(impl::transformOf(transform) * t);
}
/** Turn force and torque; the torque's reference point stays. */
template <>
inline void doTransform(const geometry_msgs::Wrench& in, geometry_msgs::Wrench& out,
                        const geometry_msgs::TransformStamped& transform) {
  doTransform(in.force, out.force, transform);
  doTransform(in.torque, out.torque, transform);
}
/** Covariance of position and rotation about fixed axes, in other axes: R C Rᵀ for each of its four blocks. */
inline boost::array<double, 36> transformCovariance(const boost::array<double, 36>& cov_in,
                                                    const Transform& transform) {
  boost::array<double, 36> result;
  const Matrix3x3& turn = transform.getBasis();
  for (int row = 0; row < 6; row += 3) {
    for (int column = 0; column < 6; column += 3) {
      Matrix3x3 block;
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) block[i][k] = cov_in[static_cast<size_t>((row + i) * 6 + column + k)];
      block = (turn * block).timesTranspose(turn);
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) result[static_cast<size_t>((row + i) * 6 + column + k)] = block[i][k];
    }
  }
  return result;
}
template <>
inline void doTransform(const geometry_msgs::PoseWithCovariance& in, geometry_msgs::PoseWithCovariance& out,
                        const geometry_msgs::TransformStamped& transform) {
  doTransform(in.pose, out.pose, transform);
  out.covariance = transformCovariance(in.covariance, impl::transformOf(transform));
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
TF2_STAMPED(PoseWithCovarianceStamped, pose)
TF2_STAMPED(TransformStamped, transform)
TF2_STAMPED(WrenchStamped, wrench)
#undef TF2_STAMPED

}  // namespace tf2
