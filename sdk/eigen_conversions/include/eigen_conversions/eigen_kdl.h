#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <kdl/frames.hpp>

namespace tf {

inline void quaternionKDLToEigen(const KDL::Rotation& k, Eigen::Quaterniond& e) {
  k.GetQuaternion(e.x(), e.y(), e.z(), e.w());
}
inline void quaternionEigenToKDL(const Eigen::Quaterniond& e, KDL::Rotation& k) {
  k = KDL::Rotation::Quaternion(e.x(), e.y(), e.z(), e.w());
}

/** Affine3d and Isometry3d. */
template <int Mode>
void transformKDLToEigen(const KDL::Frame& k, Eigen::Transform<double, 3, Mode>& e) {
  for (int row = 0; row < 3; ++row) {
    e(row, 3) = k.p[row];
    for (int column = 0; column < 3; ++column) e(row, column) = k.M(row, column);
  }
  e.makeAffine();
}
template <int Mode>
void transformEigenToKDL(const Eigen::Transform<double, 3, Mode>& e, KDL::Frame& k) {
  for (int row = 0; row < 3; ++row) {
    k.p[row] = e(row, 3);
    for (int column = 0; column < 3; ++column) k.M(row, column) = e(row, column);
  }
}

inline void twistEigenToKDL(const Eigen::Matrix<double, 6, 1>& e, KDL::Twist& k) {
  for (int i = 0; i < 6; ++i) k[i] = e[i];
}
inline void twistKDLToEigen(const KDL::Twist& k, Eigen::Matrix<double, 6, 1>& e) {
  for (int i = 0; i < 6; ++i) e[i] = k[i];
}
inline void vectorEigenToKDL(const Eigen::Matrix<double, 3, 1>& e, KDL::Vector& k) {
  for (int i = 0; i < 3; ++i) k[i] = e[i];
}
inline void vectorKDLToEigen(const KDL::Vector& k, Eigen::Matrix<double, 3, 1>& e) {
  for (int i = 0; i < 3; ++i) e[i] = k[i];
}
inline void wrenchKDLToEigen(const KDL::Wrench& k, Eigen::Matrix<double, 6, 1>& e) {
  for (int i = 0; i < 6; ++i) e[i] = k[i];
}
inline void wrenchEigenToKDL(const Eigen::Matrix<double, 6, 1>& e, KDL::Wrench& k) {
  for (int i = 0; i < 6; ++i) k[i] = e[i];
}

}  // namespace tf
