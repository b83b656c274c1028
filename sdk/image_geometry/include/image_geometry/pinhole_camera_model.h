#pragma once

#include <ros/time.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/image_encodings.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

namespace image_geometry {

class Exception : public std::runtime_error {
 public:
  explicit Exception(const std::string& description) : std::runtime_error(description) {}
};

/** Pinhole camera of a CameraInfo: pixels of its region of interest and binning, rays in its optical frame [m]. */
class PinholeCameraModel {
 public:
  /** Take a camera's parameters; false if they are those it has. Throws Exception if it is not calibrated. */
  bool fromCameraInfo(const sensor_msgs::CameraInfo& msg) {
    const bool is_same = initialized() && msg.height == info_.height && msg.width == info_.width &&
                         msg.distortion_model == info_.distortion_model && msg.D == info_.D && msg.K == info_.K &&
                         msg.R == info_.R && msg.P == info_.P && msg.binning_x == info_.binning_x &&
                         msg.binning_y == info_.binning_y && msg.roi.x_offset == info_.roi.x_offset &&
                         msg.roi.y_offset == info_.roi.y_offset && msg.roi.width == info_.roi.width &&
                         msg.roi.height == info_.roi.height && msg.roi.do_rectify == info_.roi.do_rectify;
    info_ = msg;
    if (is_same) return false;
    K_full_ = cv::Matx33d(&msg.K[0]);
    R_ = cv::Matx33d(&msg.R[0]);
    P_full_ = cv::Matx34d(&msg.P[0]);
    D_ = cv::Mat_<double>(msg.D, true).reshape(1, msg.D.empty() ? 0 : 1);
    const double x = binningX(), y = binningY();
    K_ = K_full_;
    P_ = P_full_;
    const cv::Rect roi = rawRoi();
    const cv::Rect rectified = msg.roi.do_rectify ? rectifiedRoiOf(roi) : roi;
    adjust(K_.val, 3, roi, x, y);
    adjust(P_.val, 4, rectified, x, y);
    has_maps_ = false;
    is_initialized_ = true;
    return true;
  }
  bool fromCameraInfo(const sensor_msgs::CameraInfoConstPtr& msg) { return fromCameraInfo(*msg); }

  std::string tfFrame() const { return cameraInfo().header.frame_id; }
  ros::Time stamp() const { return cameraInfo().header.stamp; }
  bool initialized() const { return is_initialized_; }
  const sensor_msgs::CameraInfo& cameraInfo() const {
    if (!is_initialized_) throw Exception("the camera model has no CameraInfo yet");
    return info_;
  }
  /** Size for which the camera was calibrated. */
  cv::Size fullResolution() const {
    return cv::Size(static_cast<int>(cameraInfo().width), static_cast<int>(info_.height));
  }
  /** Size of the images, after the region of interest and the binning. */
  cv::Size reducedResolution() const {
    const cv::Rect roi = rectifiedRoi();
    return cv::Size(roi.width / static_cast<int>(binningX()), roi.height / static_cast<int>(binningY()));
  }
  cv::Point2d toFullResolution(const cv::Point2d& uv_reduced) const {
    const cv::Rect roi = rectifiedRoi();
    return cv::Point2d(uv_reduced.x * binningX() + roi.x, uv_reduced.y * binningY() + roi.y);
  }
  cv::Point2d toReducedResolution(const cv::Point2d& uv_full) const {
    const cv::Rect roi = rectifiedRoi();
    return cv::Point2d((uv_full.x - roi.x) / binningX(), (uv_full.y - roi.y) / binningY());
  }
  /** Region of interest; without one the whole image. */
  cv::Rect rawRoi() const {
    const sensor_msgs::RegionOfInterest& roi = info_.roi;
    const bool is_whole = roi.width == 0 || roi.height == 0;
    const int width = static_cast<int>(is_whole ? info_.width : roi.width);
    const int height = static_cast<int>(is_whole ? info_.height : roi.height);
    return cv::Rect(static_cast<int>(roi.x_offset), static_cast<int>(roi.y_offset), width, height);
  }
  cv::Rect rectifiedRoi() const { return cameraInfo().roi.do_rectify ? rectifiedRoiOf(rawRoi()) : rawRoi(); }

  /** Pixel of a point in the camera's frame, in the rectified image. */
  cv::Point2d project3dToPixel(const cv::Point3d& xyz) const {
    cameraInfo();
    return cv::Point2d((fx() * xyz.x + Tx()) / xyz.z + cx(), (fy() * xyz.y + Ty()) / xyz.z + cy());
  }
  /** Ray of a rectified pixel, whose z is 1. */
  cv::Point3d projectPixelTo3dRay(const cv::Point2d& uv_rect) const {
    cameraInfo();
    return cv::Point3d((uv_rect.x - cx() - Tx()) / fx(), (uv_rect.y - cy() - Ty()) / fy(), 1.0);
  }
  void rectifyImage(const cv::Mat& raw, cv::Mat& rectified, int interpolation = cv::INTER_LINEAR) const {
    if (isUndistorted()) {
      raw.copyTo(rectified);
      return;
    }
    makeMaps();
    cv::remap(raw, rectified, map_x_, map_y_, interpolation);
  }
  /** Pixel of the rectified image at a pixel of the raw one. */
  cv::Point2d rectifyPoint(const cv::Point2d& uv_raw) const {
    if (isUndistorted()) return uv_raw;
    std::vector<cv::Point2d> points(1, uv_raw), result;
    if (cameraInfo().distortion_model == "equidistant") cv::fisheye::undistortPoints(points, result, K_, D_, R_, P_);
    else cv::undistortPoints(points, result, K_, D_, R_, P_);
    return result[0];
  }
  cv::Point2d unrectifyPoint(const cv::Point2d& uv_rect) const {
    if (isUndistorted()) return uv_rect;
    const cv::Point3d ray = projectPixelTo3dRay(uv_rect);
    const cv::Vec3d turned = R_.t() * cv::Vec3d(ray.x, ray.y, ray.z);
    std::vector<cv::Point2d> result;
    const cv::Vec3d none(0, 0, 0);
    if (info_.distortion_model == "equidistant") {
      const std::vector<cv::Point3d> points(1, cv::Point3d(turned[0] / turned[2], turned[1] / turned[2], 1.0));
      cv::fisheye::projectPoints(points, result, none, none, K_, D_);
    } else {
      const std::vector<cv::Point3d> points(1, cv::Point3d(turned[0], turned[1], turned[2]));
      cv::projectPoints(points, none, none, K_, D_, result);
    }
    return result[0];
  }
  /** Rectangle around a rectangle's edges in the rectified image. */
  cv::Rect rectifyRoi(const cv::Rect& roi_raw) const { return around(roi_raw, true); }
  cv::Rect unrectifyRoi(const cv::Rect& roi_rect) const { return around(roi_rect, false); }

  const cv::Matx33d& intrinsicMatrix() const { return K_; }
  const cv::Mat_<double>& distortionCoeffs() const { return D_; }
  const cv::Matx33d& rotationMatrix() const { return R_; }
  const cv::Matx34d& projectionMatrix() const { return P_; }
  const cv::Matx33d& fullIntrinsicMatrix() const { return K_full_; }
  const cv::Matx34d& fullProjectionMatrix() const { return P_full_; }
  double fx() const { return P_(0, 0); }
  double fy() const { return P_(1, 1); }
  double cx() const { return P_(0, 2); }
  double cy() const { return P_(1, 2); }
  double Tx() const { return P_(0, 3); }
  double Ty() const { return P_(1, 3); }
  uint32_t binningX() const { return info_.binning_x == 0 ? 1 : info_.binning_x; }
  uint32_t binningY() const { return info_.binning_y == 0 ? 1 : info_.binning_y; }
  /** Pixels of a length [m] at a depth [m], and the reverse. */
  double getDeltaU(double deltaX, double Z) const { return fx() * deltaX / Z; }
  double getDeltaV(double deltaY, double Z) const { return fy() * deltaY / Z; }
  double getDeltaX(double deltaU, double Z) const { return Z * deltaU / fx(); }
  double getDeltaY(double deltaV, double Z) const { return Z * deltaV / fy(); }

 private:
  static void adjust(double* matrix, int columns, const cv::Rect& roi, double binning_x, double binning_y) {
    matrix[2] = (matrix[2] - roi.x) / binning_x;
    matrix[columns + 2] = (matrix[columns + 2] - roi.y) / binning_y;
    matrix[0] /= binning_x;
    matrix[columns + 1] /= binning_y;
    if (columns == 4) {
      matrix[3] /= binning_x;
      matrix[columns + 3] /= binning_y;
    }
  }
  bool isUndistorted() const {
    cameraInfo();
    for (double d : info_.D)
      if (d != 0.0) return false;
    return true;
  }
  void makeMaps() const {
    if (has_maps_) return;
    const cv::Size size = reducedResolution();
    if (info_.distortion_model == "equidistant")
      cv::fisheye::initUndistortRectifyMap(K_, D_, R_, P_, size, CV_16SC2, map_x_, map_y_);
    else cv::initUndistortRectifyMap(K_, D_, R_, P_, size, CV_16SC2, map_x_, map_y_);
    has_maps_ = true;
  }
  /** Region of interest in the full rectified image. */
  cv::Rect rectifiedRoiOf(const cv::Rect& raw) const {
    if (raw.width == static_cast<int>(info_.width) && raw.height == static_cast<int>(info_.height)) return raw;
    PinholeCameraModel full;
    sensor_msgs::CameraInfo info = info_;
    info.roi = sensor_msgs::RegionOfInterest();
    info.binning_x = info.binning_y = 1;
    full.fromCameraInfo(info);
    return full.rectifyRoi(raw);
  }
  cv::Rect around(const cv::Rect& rect, bool is_raw) const {
    const double left = rect.x, top = rect.y, right = rect.x + rect.width, bottom = rect.y + rect.height;
    const cv::Point2d corners[] = {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
    double low_x = HUGE_VAL, low_y = HUGE_VAL, high_x = -HUGE_VAL, high_y = -HUGE_VAL;
    for (const cv::Point2d& corner : corners) {
      const cv::Point2d p = is_raw ? rectifyPoint(corner) : unrectifyPoint(corner);
      low_x = std::min(low_x, p.x);
      low_y = std::min(low_y, p.y);
      high_x = std::max(high_x, p.x);
      high_y = std::max(high_y, p.y);
    }
    const auto whole = [](double value) { return static_cast<int>(std::ceil(value)); };
    const int x = whole(low_x), y = whole(low_y);
    return cv::Rect(x, y, static_cast<int>(high_x) - x, static_cast<int>(high_y) - y);
  }

  sensor_msgs::CameraInfo info_;
  bool is_initialized_ = false;
  cv::Matx33d K_full_, K_, R_;
  cv::Matx34d P_full_, P_;
  cv::Mat_<double> D_;
  mutable bool has_maps_ = false;
  mutable cv::Mat map_x_, map_y_;
};

}  // namespace image_geometry
