#pragma once

#include <cstdlib>
#include <string>

namespace ros {

/** Read an environment variable; false if it is not set. */
inline bool get_environment_variable(std::string& value, const char* name) {
  const char* const found = std::getenv(name);
  value = found ? found : "";
  return found != nullptr;
}

}  // namespace ros
