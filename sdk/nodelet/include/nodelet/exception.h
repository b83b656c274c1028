#pragma once

#include <stdexcept>
#include <string>

namespace nodelet {

class Exception : public std::runtime_error {
 public:
  explicit Exception(const std::string& what) : std::runtime_error(what) {}
};
class UninitializedException : public Exception {
 public:
  explicit UninitializedException(const std::string& method)
      : Exception("Calling [" + method + "] before the Nodelet is initialized is not allowed.") {}
};
class MultipleInitializationException : public Exception {
 public:
  MultipleInitializationException() : Exception("Initialized multiple times") {}
};

}  // namespace nodelet
