#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace EigenSTL {

/** Map to a type of Eigen, aligned as the type needs. */
template <typename Key, typename T>
using aligned_map = std::map<Key, T, std::less<Key>, Eigen::aligned_allocator<std::pair<const Key, T>>>;

typedef aligned_map<std::string, Eigen::Vector3d> map_string_Vector3d;
typedef aligned_map<std::string, Eigen::Vector3f> map_string_Vector3f;
typedef aligned_map<std::string, Eigen::Affine3d> map_string_Affine3d;
typedef aligned_map<std::string, Eigen::Affine3f> map_string_Affine3f;
typedef aligned_map<std::string, Eigen::Isometry3d> map_string_Isometry3d;
typedef aligned_map<std::string, Eigen::Isometry3f> map_string_Isometry3f;

}  // namespace EigenSTL
