#pragma once

#include <string>

namespace topic_tools {

/** Last part of a name, without the slashes after it; false, and no change, if there is none. */
inline bool getBaseName(const std::string& full_name, std::string& base_name) {
  const std::string::size_type last = full_name.find_last_not_of('/');
  if (last == std::string::npos) return false;
  const std::string::size_type slash = full_name.rfind('/', last);
  const std::string::size_type first = slash == std::string::npos ? 0 : slash + 1;
  base_name = full_name.substr(first, last - first + 1);
  return true;
}

}  // namespace topic_tools
