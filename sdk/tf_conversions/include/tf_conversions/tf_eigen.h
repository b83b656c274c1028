#pragma once

#include <tf/transform_datatypes.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tf {

inline void matrixTFToEigen(const tf::Matrix3x3& t, Eigen::Matrix3d& e) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) e(i, k) = t[i][k];
}
inline void matrixEigenToTF(const Eigen::Matrix3d& e, tf::Matrix3x3& t) {
  t.setValue(e(0, 0), e(0, 1), e(0, 2), e(1, 0), e(1, 1), e(1, 2), e(2, 0), e(2, 1), e(2, 2));
}
inline void vectorTFToEigen(const tf::Vector3& t, Eigen::Vector3d& e) { e = Eigen::Vector3d(t.x(), t.y(), t.z()); }
inline void vectorEigenToTF(const Eigen::Vector3d& e, tf::Vector3& t) { t.setValue(e.x(), e.y(), e.z()); }
inline void quaternionTFToEigen(const tf::Quaternion& t, Eigen::Quaterniond& e) {
  e = Eigen::Quaterniond(t.w(), t.x(), t.y(), t.z());
}
inline void quaternionEigenToTF(const Eigen::Quaterniond& e, tf::Quaternion& t) {
  t.setValue(e.x(), e.y(), e.z(), e.w());
}
template <int mode>
inline void transformTFToEigen(const tf::Transform& t, Eigen::Transform<double, 3, mode>& e) {
  Eigen::Matrix3d linear;
  matrixTFToEigen(t.getBasis(), linear);
  e = Eigen::Translation3d(t.getOrigin().x(), t.getOrigin().y(), t.getOrigin().z()) * Eigen::Quaterniond(linear);
}
template <int mode>
inline void transformEigenToTF(const Eigen::Transform<double, 3, mode>& e, tf::Transform& t) {
  tf::Matrix3x3 basis;
  tf::Vector3 origin;
  matrixEigenToTF(e.linear(), basis);
  vectorEigenToTF(e.translation(), origin);
  t = tf::Transform(basis, origin);
}
template <int mode>
inline void poseTFToEigen(const tf::Pose& t, Eigen::Transform<double, 3, mode>& e) {
  transformTFToEigen(t, e);
}
template <int mode>
inline void poseEigenToTF(const Eigen::Transform<double, 3, mode>& e, tf::Pose& t) {
  transformEigenToTF(e, t);
}

}  // namespace tf
