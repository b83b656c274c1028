#pragma once

#include <limits>

#include "image_geometry/pinhole_camera_model.h"

namespace image_geometry {

/** Two rectified cameras side by side; points are in the left one's optical frame [m]. */
class StereoCameraModel {
 public:
  static constexpr double MISSING_Z = 10000.0;

  bool fromCameraInfo(const sensor_msgs::CameraInfo& left, const sensor_msgs::CameraInfo& right) {
    const bool is_left_new = left_.fromCameraInfo(left), is_right_new = right_.fromCameraInfo(right);
    if (left_.fx() != right_.fx() || left_.fy() != right_.fy() || left_.cy() != right_.cy() || left_.Tx() != 0.0)
      throw Exception("the cameras are no rectified pair: their focal lengths and rows must be equal, left Tx 0");
    return is_left_new || is_right_new;
  }
  bool fromCameraInfo(const sensor_msgs::CameraInfoConstPtr& left, const sensor_msgs::CameraInfoConstPtr& right) {
    return fromCameraInfo(*left, *right);
  }
  bool initialized() const { return left_.initialized() && right_.initialized(); }
  const PinholeCameraModel& left() const { return left_; }
  const PinholeCameraModel& right() const { return right_; }
  std::string tfFrame() const { return left_.tfFrame(); }

  /** Distance of the cameras [m]. */
  double baseline() const { return -right_.Tx() / right_.fx(); }
  double getZ(double disparity) const { return -right_.Tx() / (disparity - (left_.cx() - right_.cx())); }
  double getDisparity(double Z) const { return -right_.Tx() / Z + left_.cx() - right_.cx(); }
  void projectDisparityTo3d(const cv::Point2d& left_uv_rect, float disparity, cv::Point3d& xyz) const {
    const double z = getZ(disparity);
    const cv::Point3d ray = left_.projectPixelTo3dRay(left_uv_rect);
    xyz = cv::Point3d(ray.x * z, ray.y * z, z);
  }
  /** Points of a disparity image of type CV_32F, as CV_32FC3. */
  void projectDisparityImageTo3d(const cv::Mat& disparity, cv::Mat& point_cloud,
                                 bool handleMissingValues = false) const {
    cv::reprojectImageTo3D(disparity, point_cloud, reprojectionMatrix(), handleMissingValues);
  }
  cv::Matx44d reprojectionMatrix() const {
    const double fx = left_.fx(), fy = left_.fy(), tx = -baseline();
    return cv::Matx44d(fy * tx, 0, 0, -fy * left_.cx() * tx, 0, fx * tx, 0, -fx * left_.cy() * tx, 0, 0, 0,
                       fx * fy * tx, 0, 0, -fy, fy * (left_.cx() - right_.cx()));
  }

 private:
  PinholeCameraModel left_, right_;
};

}  // namespace image_geometry
