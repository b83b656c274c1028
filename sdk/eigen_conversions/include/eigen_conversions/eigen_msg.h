#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Wrench.h>
#include <std_msgs/Float64MultiArray.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tf {

inline void pointMsgToEigen(const geometry_msgs::Point& m, Eigen::Vector3d& e) { e = Eigen::Vector3d(m.x, m.y, m.z); }
inline void pointEigenToMsg(const Eigen::Vector3d& e, geometry_msgs::Point& m) {
  m.x = e.x();
  m.y = e.y();
  m.z = e.z();
}
inline void vectorMsgToEigen(const geometry_msgs::Vector3& m, Eigen::Vector3d& e) {
  e = Eigen::Vector3d(m.x, m.y, m.z);
}
inline void vectorEigenToMsg(const Eigen::Vector3d& e, geometry_msgs::Vector3& m) {
  m.x = e.x();
  m.y = e.y();
  m.z = e.z();
}
inline void quaternionMsgToEigen(const geometry_msgs::Quaternion& m, Eigen::Quaterniond& e) {
  e = Eigen::Quaterniond(m.w, m.x, m.y, m.z);
}
inline void quaternionEigenToMsg(const Eigen::Quaterniond& e, geometry_msgs::Quaternion& m) {
  m.x = e.x();
  m.y = e.y();
  m.z = e.z();
  m.w = e.w();
}

/** Poses and transforms, as Affine3d or Isometry3d. */
template <int mode>
inline void poseMsgToEigen(const geometry_msgs::Pose& m, Eigen::Transform<double, 3, mode>& e) {
  e = Eigen::Translation3d(m.position.x, m.position.y, m.position.z) *
      Eigen::Quaterniond(m.orientation.w, m.orientation.x, m.orientation.y, m.orientation.z);
}
template <int mode>
inline void poseEigenToMsg(const Eigen::Transform<double, 3, mode>& e, geometry_msgs::Pose& m) {
  pointEigenToMsg(e.translation(), m.position);
  Eigen::Quaterniond q(e.linear());
  if (q.w() < 0) q.coeffs() *= -1;
  quaternionEigenToMsg(q, m.orientation);
}
template <int mode>
inline void transformMsgToEigen(const geometry_msgs::Transform& m, Eigen::Transform<double, 3, mode>& e) {
  e = Eigen::Translation3d(m.translation.x, m.translation.y, m.translation.z) *
      Eigen::Quaterniond(m.rotation.w, m.rotation.x, m.rotation.y, m.rotation.z);
}
template <int mode>
inline void transformEigenToMsg(const Eigen::Transform<double, 3, mode>& e, geometry_msgs::Transform& m) {
  vectorEigenToMsg(e.translation(), m.translation);
  quaternionEigenToMsg(Eigen::Quaterniond(e.linear()), m.rotation);
}

/** Linear part first. */
inline void twistMsgToEigen(const geometry_msgs::Twist& m, Eigen::Matrix<double, 6, 1>& e) {
  e << m.linear.x, m.linear.y, m.linear.z, m.angular.x, m.angular.y, m.angular.z;
}
inline void twistEigenToMsg(const Eigen::Matrix<double, 6, 1>& e, geometry_msgs::Twist& m) {
  vectorEigenToMsg(e.head<3>(), m.linear);
  vectorEigenToMsg(e.tail<3>(), m.angular);
}
inline void wrenchMsgToEigen(const geometry_msgs::Wrench& m, Eigen::Matrix<double, 6, 1>& e) {
  e << m.force.x, m.force.y, m.force.z, m.torque.x, m.torque.y, m.torque.z;
}
inline void wrenchEigenToMsg(const Eigen::Matrix<double, 6, 1>& e, geometry_msgs::Wrench& m) {
  vectorEigenToMsg(e.head<3>(), m.force);
  vectorEigenToMsg(e.tail<3>(), m.torque);
}

/** Message with a matrix's numbers, row by row. */
template <class Derived>
void matrixEigenToMsg(const Eigen::MatrixBase<Derived>& e, std_msgs::Float64MultiArray& m) {
  m.layout.dim.resize(2);
  m.layout.dim[0].size = static_cast<uint32_t>(e.rows());
  m.layout.dim[0].stride = static_cast<uint32_t>(e.rows() * e.cols());
  m.layout.dim[1].size = m.layout.dim[1].stride = static_cast<uint32_t>(e.cols());
  m.data.clear();
  for (int i = 0; i < e.rows(); ++i)
    for (int k = 0; k < e.cols(); ++k) m.data.push_back(e(i, k));
}

}  // namespace tf
