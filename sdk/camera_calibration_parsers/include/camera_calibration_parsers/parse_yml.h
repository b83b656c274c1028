#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <iosfwd>
#include <string>

namespace camera_calibration_parsers {

bool writeCalibrationYml(std::ostream& out, const std::string& camera_name, const sensor_msgs::CameraInfo& cam_info);
bool readCalibrationYml(std::istream& in, std::string& camera_name, sensor_msgs::CameraInfo& cam_info);
bool writeCalibrationYml(const std::string& file_name, const std::string& camera_name,
                         const sensor_msgs::CameraInfo& cam_info);
bool readCalibrationYml(const std::string& file_name, std::string& camera_name, sensor_msgs::CameraInfo& cam_info);

}  // namespace camera_calibration_parsers
