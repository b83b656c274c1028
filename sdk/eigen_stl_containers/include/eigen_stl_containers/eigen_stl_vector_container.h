#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/StdVector>
#include <vector>

namespace EigenSTL {

/** Vector of a type of Eigen, aligned as the type needs. */
template <typename T>
using aligned_vector = std::vector<T, Eigen::aligned_allocator<T>>;

typedef aligned_vector<Eigen::Vector2d> vector_Vector2d;
typedef aligned_vector<Eigen::Vector2f> vector_Vector2f;
typedef aligned_vector<Eigen::Vector3d> vector_Vector3d;
typedef aligned_vector<Eigen::Vector3f> vector_Vector3f;
typedef aligned_vector<Eigen::Vector4d> vector_Vector4d;
typedef aligned_vector<Eigen::Vector4f> vector_Vector4f;
typedef aligned_vector<Eigen::Quaterniond> vector_Quaterniond;
typedef aligned_vector<Eigen::Quaternionf> vector_Quaternionf;
typedef aligned_vector<Eigen::Affine3d> vector_Affine3d;
typedef aligned_vector<Eigen::Affine3f> vector_Affine3f;
typedef aligned_vector<Eigen::Isometry3d> vector_Isometry3d;
typedef aligned_vector<Eigen::Isometry3f> vector_Isometry3f;

}  // namespace EigenSTL
