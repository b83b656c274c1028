#pragma once

#include <stdexcept>
#include <string>

namespace ros {

/** Base of all exceptions of ros. */
class Exception : public std::runtime_error {
 public:
  explicit Exception(const std::string& what) : std::runtime_error(what) {}
};

}  // namespace ros
