#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <string>

namespace camera_calibration_parsers {

/** Read a camera's calibration from a YAML file; false, with a logged reason, if it is missing or invalid. */
bool readCalibration(const std::string& file_name, std::string& camera_name, sensor_msgs::CameraInfo& cam_info);
/** Write a camera's calibration to a YAML file. */
bool writeCalibration(const std::string& file_name, const std::string& camera_name,
                      const sensor_msgs::CameraInfo& cam_info);

}  // namespace camera_calibration_parsers
