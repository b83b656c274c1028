#include "camera_calibration_parsers/parse_yml.h"

#include <ros/console.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <istream>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

#include "camera_calibration_parsers/parse.h"

namespace camera_calibration_parsers {
namespace {

constexpr size_t kMaxSize = 1 << 20;

std::string stripped(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r\n\"'");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r\n\"'") - first + 1);
}

/** Values of the keys, those of a nested map as `map/key`: the part of YAML that calibrations use. */
std::map<std::string, std::string> valuesOf(std::istream& in) {
  std::map<std::string, std::string> values;
  std::string line, outer, key;
  size_t size = 0;
  while (std::getline(in, line)) {
    if ((size += line.size()) > kMaxSize) throw std::runtime_error("the file is too long");
    const size_t comment = line.find(" #");
    if (comment != std::string::npos) line.erase(comment);
    if (line.empty() || line[0] == '#' || line[0] == '%' || line.compare(0, 3, "---") == 0) continue;
    const bool is_nested = line[0] == ' ' || line[0] == '\t';
    const std::string before = key.empty() ? "" : values[key];
    const bool is_list = !before.empty() && before[0] == '[' && before.find(']') == std::string::npos;
    const size_t colon = line.find(':');
    if (is_list) {
      values[key] += line;
    } else if (is_nested && stripped(line)[0] == '-') {  // a list in lines of its own
      values[key] += (before.empty() ? "" : ",") + stripped(line).substr(1);
    } else if (colon != std::string::npos) {
      const std::string name = stripped(line.substr(0, colon));
      if (!is_nested) outer = name;
      key = is_nested ? outer + "/" + name : name;
      values[key] = stripped(line.substr(colon + 1));
    }
  }
  return values;
}

double numberOf(const std::string& key, const std::string& text) {
  char* end = nullptr;
  const std::string word = stripped(text);
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0' || !std::isfinite(value))
    throw std::runtime_error(key + ": '" + word + "' is no number");
  return value;
}

std::vector<double> numbersOf(const std::map<std::string, std::string>& values, const std::string& key, size_t count) {
  const auto found = values.find(key + "/data");
  if (found == values.end()) throw std::runtime_error(key + " is missing");
  std::string text = found->second;
  for (char& c : text)
    if (c == '[' || c == ']') c = ' ';
  std::vector<double> numbers;
  for (size_t at = 0; at <= text.size() && !stripped(text).empty();) {
    const size_t comma = std::min(text.find(',', at), text.size());
    numbers.push_back(numberOf(key, text.substr(at, comma - at)));
    at = comma + 1;
  }
  if (count != 0 && numbers.size() != count)
    throw std::runtime_error(key + " has " + std::to_string(numbers.size()) + " numbers, not " + std::to_string(count));
  return numbers;
}

template <class Array>
void fill(Array& array, const std::vector<double>& numbers) {
  std::copy(numbers.begin(), numbers.end(), array.begin());
}

uint32_t sizeOf(const std::map<std::string, std::string>& values, const std::string& key) {
  const auto found = values.find(key);
  const double value = found == values.end() ? -1.0 : numberOf(key, found->second);
  if (value < 0 || value > std::numeric_limits<uint32_t>::max())
    throw std::runtime_error(key + " is missing or invalid");
  return static_cast<uint32_t>(value);
}

void writeMatrix(std::ostream& out, const char* name, size_t rows, const double* data, size_t count) {
  out << name << ":\n  rows: " << rows << "\n  cols: " << count / rows << "\n  data: [";
  for (size_t i = 0; i < count; ++i) out << (i == 0 ? "" : ", ") << data[i];
  out << "]\n";
}

}  // namespace

bool writeCalibrationYml(std::ostream& out, const std::string& camera_name, const sensor_msgs::CameraInfo& info) {
  out << std::setprecision(17);
  out << "image_width: " << info.width << "\nimage_height: " << info.height << "\ncamera_name: " << camera_name << '\n';
  writeMatrix(out, "camera_matrix", 3, info.K.data(), info.K.size());
  out << "distortion_model: " << (info.distortion_model.empty() ? "plumb_bob" : info.distortion_model) << '\n';
  writeMatrix(out, "distortion_coefficients", 1, info.D.data(), info.D.size());
  writeMatrix(out, "rectification_matrix", 3, info.R.data(), info.R.size());
  writeMatrix(out, "projection_matrix", 3, info.P.data(), info.P.size());
  return out.good();
}

bool readCalibrationYml(std::istream& in, std::string& camera_name, sensor_msgs::CameraInfo& cam_info) {
  try {
    const std::map<std::string, std::string> values = valuesOf(in);
    sensor_msgs::CameraInfo info = cam_info;
    info.width = sizeOf(values, "image_width");
    info.height = sizeOf(values, "image_height");
    fill(info.K, numbersOf(values, "camera_matrix", info.K.size()));
    fill(info.R, numbersOf(values, "rectification_matrix", info.R.size()));
    fill(info.P, numbersOf(values, "projection_matrix", info.P.size()));
    info.D = numbersOf(values, "distortion_coefficients", 0);
    const auto model = values.find("distortion_model"), name = values.find("camera_name");
    info.distortion_model = model == values.end() ? "plumb_bob" : model->second;
    camera_name = name == values.end() ? "unknown" : name->second;
    cam_info = info;
    return true;
  } catch (const std::runtime_error& error) {
    ROS_ERROR("camera calibration: %s", error.what());
    return false;
  }
}

bool writeCalibrationYml(const std::string& file_name, const std::string& camera_name,
                         const sensor_msgs::CameraInfo& cam_info) {
  std::ofstream out(file_name);
  if (out && writeCalibrationYml(out, camera_name, cam_info) && out.flush()) return true;
  ROS_ERROR("cannot write the camera calibration %s: %s", file_name.c_str(), std::strerror(errno));
  return false;
}

bool readCalibrationYml(const std::string& file_name, std::string& camera_name, sensor_msgs::CameraInfo& cam_info) {
  std::ifstream in(file_name);
  if (in && readCalibrationYml(in, camera_name, cam_info)) return true;
  ROS_ERROR("cannot read the camera calibration %s", file_name.c_str());
  return false;
}

bool readCalibration(const std::string& file_name, std::string& camera_name, sensor_msgs::CameraInfo& cam_info) {
  return readCalibrationYml(file_name, camera_name, cam_info);
}
bool writeCalibration(const std::string& file_name, const std::string& camera_name,
                      const sensor_msgs::CameraInfo& cam_info) {
  return writeCalibrationYml(file_name, camera_name, cam_info);
}

}  // namespace camera_calibration_parsers
