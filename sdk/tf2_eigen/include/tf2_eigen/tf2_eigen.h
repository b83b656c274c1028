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

}  // namespace tf2
