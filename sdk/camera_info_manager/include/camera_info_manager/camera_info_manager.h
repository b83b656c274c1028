#pragma once

#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/SetCameraInfo.h>

#include <boost/thread/mutex.hpp>
#include <string>

namespace camera_info_manager {

/** A camera driver's calibration: read from a URL, offered by the service set_camera_info, which also stores it.
 *
 * URLs are `file:///…` and `package://PACKAGE/…`, with ${NAME}, the camera's name, and ${ROS_HOME}; an empty URL is
 * `file://${ROS_HOME}/camera_info/${NAME}.yaml`.
 */
class CameraInfoManager {
 public:
  CameraInfoManager(ros::NodeHandle nh, const std::string& cname = "camera", const std::string& url = "");

  /** The calibration; zeros if there is none. */
  sensor_msgs::CameraInfo getCameraInfo();
  bool isCalibrated();
  /** Read a calibration; the present one stays if that fails. */
  bool loadCameraInfo(const std::string& url);
  /** URL with values for its variables. */
  std::string resolveURL(const std::string& url, const std::string& cname);
  bool setCameraName(const std::string& cname);
  bool setCameraInfo(const sensor_msgs::CameraInfo& camera_info);
  /** True if the URL is of a kind that is known. */
  bool validateURL(const std::string& url);

 private:
  /** File of a URL; "" if there is none. */
  std::string fileOf(const std::string& url, const std::string& cname);
  /** Read the calibration, unless that was tried; false if it was not read. */
  bool load();
  bool set(sensor_msgs::SetCameraInfo::Request& request, sensor_msgs::SetCameraInfo::Response& response);

  boost::mutex mutex_;
  ros::NodeHandle node_;
  ros::ServiceServer service_;
  std::string name_, url_;
  sensor_msgs::CameraInfo info_;
  bool is_loaded_ = false;
};

}  // namespace camera_info_manager
