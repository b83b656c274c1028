#pragma once

#include <exception>
#include <string>

namespace XmlRpc {

/** Thrown if a value is of another type than requested, or XML is invalid. */
class XmlRpcException : public std::exception {
 public:
  explicit XmlRpcException(const std::string& message, int code = -1) : message_(message), code_(code) {}
  const std::string& getMessage() const { return message_; }
  int getCode() const { return code_; }
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
  int code_;
};

}  // namespace XmlRpc
