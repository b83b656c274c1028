#include "camera_info_manager/camera_info_manager.h"

#include <camera_calibration_parsers/parse.h>
#include <ros/package.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>

namespace camera_info_manager {
namespace {

const std::string kDefaultUrl = "file://${ROS_HOME}/camera_info/${NAME}.yaml";
const std::string kFile = "file://", kPackage = "package://";

bool startsWith(const std::string& text, const std::string& start) { return text.compare(0, start.size(), start) == 0; }

std::string rosHome() {
  if (const char* home = std::getenv("ROS_HOME")) return home;
  const char* const home = std::getenv("HOME");
  return std::string(home ? home : "") + "/.ros";
}

void replaceAll(std::string& text, const std::string& word, const std::string& by) {
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size()))
    text.replace(at, word.size(), by);
}

typedef boost::mutex::scoped_lock Lock;

}  // namespace

CameraInfoManager::CameraInfoManager(ros::NodeHandle nh, const std::string& cname, const std::string& url)
    : node_(nh), name_(cname), url_(url) {
  service_ = node_.advertiseService("set_camera_info", &CameraInfoManager::set, this);
}

sensor_msgs::CameraInfo CameraInfoManager::getCameraInfo() {
  const Lock lock(mutex_);
  load();
  return info_;
}

bool CameraInfoManager::isCalibrated() {
  const Lock lock(mutex_);
  load();
  return info_.K[0] != 0.0;
}

bool CameraInfoManager::loadCameraInfo(const std::string& url) {
  const Lock lock(mutex_);
  url_ = url;
  is_loaded_ = false;
  return load();
}

std::string CameraInfoManager::resolveURL(const std::string& url, const std::string& cname) {
  std::string resolved = url.empty() ? kDefaultUrl : url;
  replaceAll(resolved, "${NAME}", cname);
  replaceAll(resolved, "${ROS_HOME}", rosHome());
  return resolved;
}

bool CameraInfoManager::setCameraName(const std::string& cname) {
  for (char c : cname)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return false;
  if (cname.empty()) return false;
  const Lock lock(mutex_);
  name_ = cname;
  is_loaded_ = false;
  return true;
}

bool CameraInfoManager::setCameraInfo(const sensor_msgs::CameraInfo& camera_info) {
  const Lock lock(mutex_);
  info_ = camera_info;
  is_loaded_ = true;
  return true;
}

bool CameraInfoManager::validateURL(const std::string& url) {
  const Lock lock(mutex_);
  const std::string resolved = resolveURL(url, name_);
  const size_t slash = resolved.find('/', kPackage.size());
  return startsWith(resolved, kFile + "/") ||
         (startsWith(resolved, kPackage) && slash != std::string::npos && slash > kPackage.size());
}

std::string CameraInfoManager::fileOf(const std::string& url, const std::string& cname) {
  const std::string resolved = resolveURL(url, cname);
  if (startsWith(resolved, kFile)) return resolved.substr(kFile.size());
  const size_t slash = resolved.find('/', kPackage.size());
  if (startsWith(resolved, kPackage) && slash != std::string::npos) {
    const std::string package = resolved.substr(kPackage.size(), slash - kPackage.size());
    const std::string folder = ros::package::getPath(package);
    if (!folder.empty()) return folder + resolved.substr(slash);
    ROS_ERROR("camera calibration: no package %s, of %s", package.c_str(), resolved.c_str());
    return "";
  }
  ROS_ERROR("camera calibration: %s begins neither with file:// nor with package://", resolved.c_str());
  return "";
}

bool CameraInfoManager::load() {
  if (is_loaded_) return false;
  is_loaded_ = true;
  const std::string file = fileOf(url_, name_);
  if (file.empty()) return false;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    ROS_INFO("the camera %s is not calibrated: %s is missing", name_.c_str(), file.c_str());
    return false;
  }
  std::string written;
  if (!camera_calibration_parsers::readCalibration(file, written, info_)) return false;
  if (written != name_)
    ROS_WARN("the calibration %s is of the camera %s, not of %s", file.c_str(), written.c_str(), name_.c_str());
  return true;
}

bool CameraInfoManager::set(sensor_msgs::SetCameraInfo::Request& request,
                            sensor_msgs::SetCameraInfo::Response& response) {
  const Lock lock(mutex_);
  info_ = request.camera_info;
  is_loaded_ = true;
  const std::string file = fileOf(startsWith(url_, kPackage) || startsWith(url_, kFile) ? url_ : "", name_);
  std::error_code error;
  if (!file.empty()) std::filesystem::create_directories(std::filesystem::path(file).parent_path(), error);
  response.success = !file.empty() && camera_calibration_parsers::writeCalibration(file, name_, info_);
  if (!response.success) response.status_message = "cannot store the calibration in " + file;
  return true;
}

}  // namespace camera_info_manager
