#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/QuaternionStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Twist.h>
#include <tf2/convert.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tf2 {

inline Eigen::Isometry3d transformToEigen(const geometry_msgs::Transform& m) {
  return Eigen::Isometry3d(Eigen::Translation3d(m.translation.x, m.translation.y, m.translation.z) *
                           Eigen::Quaterniond(m.rotation.w, m.rotation.x, m.rotation.y, m.rotation.z));
}
inline Eigen::Isometry3d transformToEigen(const geometry_msgs::TransformStamped& m) {
  return transformToEigen(m.transform);
}
template <int mode>
inline geometry_msgs::TransformStamped eigenToTransform(const Eigen::Transform<double, 3, mode>& e) {
  geometry_msgs::TransformStamped m;
  const Eigen::Quaterniond q(e.linear());
  m.transform.translation.x = e.translation().x();
  m.transform.translation.y = e.translation().y();
  m.transform.translation.z = e.translation().z();
  m.transform.rotation.x = q.x();
  m.transform.rotation.y = q.y();
  m.transform.rotation.z = q.z();
  m.transform.rotation.w = q.w();
  return m;
}

inline geometry_msgs::Point toMsg(const Eigen::Vector3d& e) {
  geometry_msgs::Point m;
  m.x = e.x();
  m.y = e.y();
  m.z = e.z();
  return m;
}
inline geometry_msgs::Vector3& toMsg(const Eigen::Vector3d& e, geometry_msgs::Vector3& m) {
  m.x = e.x();
  m.y = e.y();
  m.z = e.z();
  return m;
}
inline void fromMsg(const geometry_msgs::Point& m, Eigen::Vector3d& e) { e = Eigen::Vector3d(m.x, m.y, m.z); }
inline void fromMsg(const geometry_msgs::Vector3& m, Eigen::Vector3d& e) { e = Eigen::Vector3d(m.x, m.y, m.z); }
inline geometry_msgs::Quaternion toMsg(const Eigen::Quaterniond& e) {
  geometry_msgs::Quaternion m;
  m.x = e.x();
  m.y = e.y();
  m.z = e.z();
  m.w = e.w();
  return m;
}
inline void fromMsg(const geometry_msgs::Quaternion& m, Eigen::Quaterniond& e) {
  e = Eigen::Quaterniond(m.w, m.x, m.y, m.z);
}
template <int mode>
inline geometry_msgs::Pose toMsg(const Eigen::Transform<double, 3, mode>& e) {
  geometry_msgs::Pose m;
  m.position = toMsg(Eigen::Vector3d(e.translation()));
  Eigen::Quaterniond q(e.linear());
  if (q.w() < 0) q.coeffs() *= -1;
  m.orientation = toMsg(q);
  return m;
}
template <int mode>
inline void fromMsg(const geometry_msgs::Pose& m, Eigen::Transform<double, 3, mode>& e) {
  e = Eigen::Translation3d(m.position.x, m.position.y, m.position.z) *
      Eigen::Quaterniond(m.orientation.w, m.orientation.x, m.orientation.y, m.orientation.z);
}

inline geometry_msgs::Twist toMsg(const Eigen::Matrix<double, 6, 1>& e) {
  geometry_msgs::Twist m;
  toMsg(Eigen::Vector3d(e.head<3>()), m.linear);
  toMsg(Eigen::Vector3d(e.tail<3>()), m.angular);
  return m;
}
inline void fromMsg(const geometry_msgs::Twist& m, Eigen::Matrix<double, 6, 1>& e) {
  e << m.linear.x, m.linear.y, m.linear.z, m.angular.x, m.angular.y, m.angular.z;
}

namespace impl {

template <class M, class T>
M stamped_message(const Stamped<T>& stamped) {
  M m;
  m.header.stamp = stamped.stamp_;
  m.header.frame_id = stamped.frame_id_;
  return m;
}
template <class M, class Part, class T>
void from_stamped(const M& m, const Part& part, Stamped<T>& out) {
  fromMsg(part, static_cast<T&>(out));
  out.stamp_ = m.header.stamp;
  out.frame_id_ = m.header.frame_id;
}

}  // namespace impl

inline geometry_msgs::PointStamped toMsg(const Stamped<Eigen::Vector3d>& e) {
  auto m = impl::stamped_message<geometry_msgs::PointStamped>(e);
  m.point = toMsg(static_cast<const Eigen::Vector3d&>(e));
  return m;
}
inline void fromMsg(const geometry_msgs::PointStamped& m, Stamped<Eigen::Vector3d>& e) {
  impl::from_stamped(m, m.point, e);
}
inline geometry_msgs::QuaternionStamped toMsg(const Stamped<Eigen::Quaterniond>& e) {
  auto m = impl::stamped_message<geometry_msgs::QuaternionStamped>(e);
  m.quaternion = toMsg(static_cast<const Eigen::Quaterniond&>(e));
  return m;
}
inline void fromMsg(const geometry_msgs::QuaternionStamped& m, Stamped<Eigen::Quaterniond>& e) {
  impl::from_stamped(m, m.quaternion, e);
}
template <int mode>
inline geometry_msgs::PoseStamped toMsg(const Stamped<Eigen::Transform<double, 3, mode>>& e) {
  auto m = impl::stamped_message<geometry_msgs::PoseStamped>(e);
  m.pose = toMsg(static_cast<const Eigen::Transform<double, 3, mode>&>(e));
  return m;
}
template <int mode>
inline void fromMsg(const geometry_msgs::PoseStamped& m, Stamped<Eigen::Transform<double, 3, mode>>& e) {
  impl::from_stamped(m, m.pose, e);
}

template <>
inline void doTransform(const Eigen::Vector3d& in, Eigen::Vector3d& out,
                        const geometry_msgs::TransformStamped& transform) {
  out = transformToEigen(transform) * in;
}
template <>
inline void doTransform(const Eigen::Isometry3d& in, Eigen::Isometry3d& out,
                        const geometry_msgs::TransformStamped& transform) {
  out = transformToEigen(transform) * in;
}
template <>
inline void doTransform(const Eigen::Affine3d& in, Eigen::Affine3d& out,
                        const geometry_msgs::TransformStamped& transform) {
  out = Eigen::Affine3d(transformToEigen(transform)) * in;
}
// As in Noetic, by the inverse of the transform's rotation.
template <>
inline void doTransform(const Eigen::Quaterniond& in, Eigen::Quaterniond& out,
                        const geometry_msgs::TransformStamped& transform) {
  const Eigen::Quaterniond q(transformToEigen(transform).linear());
  out = q.inverse() * in * q;
}

namespace impl {

template <class T>
void transform_stamped(const Stamped<T>& in, Stamped<T>& out, const geometry_msgs::TransformStamped& transform) {
  doTransform(static_cast<const T&>(in), static_cast<T&>(out), transform);
  out.stamp_ = transform.header.stamp;
  out.frame_id_ = transform.header.frame_id;
}

}  // namespace impl

template <>
inline void doTransform(const Stamped<Eigen::Vector3d>& in, Stamped<Eigen::Vector3d>& out,
                        const geometry_msgs::TransformStamped& transform) {
  impl::transform_stamped(in, out, transform);
}
template <>
inline void doTransform(const Stamped<Eigen::Quaterniond>& in, Stamped<Eigen::Quaterniond>& out,
                        const geometry_msgs::TransformStamped& transform) {
  impl::transform_stamped(in, out, transform);
}
template <>
inline void doTransform(const Stamped<Eigen::Isometry3d>& in, Stamped<Eigen::Isometry3d>& out,
                        const geometry_msgs::TransformStamped& transform) {
  impl::transform_stamped(in, out, transform);
}
template <>
inline void doTransform(const Stamped<Eigen::Affine3d>& in, Stamped<Eigen::Affine3d>& out,
                        const geometry_msgs::TransformStamped& transform) {
  impl::transform_stamped(in, out, transform);
}

}  // namespace tf2

// Where tf2::convert() looks for them.
namespace Eigen {
using tf2::fromMsg;
using tf2::toMsg;
}  // namespace Eigen
