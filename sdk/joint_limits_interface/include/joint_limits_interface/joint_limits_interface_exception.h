#pragma once

#include <exception>
#include <string>

namespace joint_limits_interface {

class JointLimitsInterfaceException : public std::exception {
 public:
  explicit JointLimitsInterfaceException(const std::string& message) : msg(message) {}
  virtual ~JointLimitsInterfaceException() throw() {}
  virtual const char* what() const throw() { return msg.c_str(); }

 private:
  std::string msg;
};

}  // namespace joint_limits_interface
