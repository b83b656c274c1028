#pragma once

#include <stdexcept>
#include <string>

namespace urdf {

class ParseError : public std::runtime_error {
 public:
  explicit ParseError(const std::string& error_msg) : std::runtime_error(error_msg) {}
};

}  // namespace urdf
