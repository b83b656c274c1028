#pragma once

#include <string>

namespace image_transport {

/** Topic camera_info beside an image's topic. */
inline std::string getCameraInfoTopic(const std::string& base_topic) {
  const size_t end = base_topic.find_last_not_of('/');
  const size_t slash = end == std::string::npos ? end : base_topic.rfind('/', end);
  return (slash == std::string::npos ? std::string() : base_topic.substr(0, slash + 1)) + "camera_info";
}

}  // namespace image_transport
