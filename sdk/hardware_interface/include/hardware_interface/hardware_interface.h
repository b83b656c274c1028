#pragma once

#include <exception>
#include <set>
#include <string>

namespace hardware_interface {

/** Base of all interfaces: it knows which of its resources were claimed. */
class HardwareInterface {
 public:
  virtual ~HardwareInterface() {}

  virtual void claim(std::string resource) { claims_.insert(resource); }
  void clearClaims() { claims_.clear(); }
  std::set<std::string> getClaims() const { return claims_; }

 private:
  std::set<std::string> claims_;
};

class HardwareInterfaceException : public std::exception {
 public:
  explicit HardwareInterfaceException(const std::string& message) : msg(message) {}
  virtual ~HardwareInterfaceException() throw() {}
  virtual const char* what() const throw() { return msg.c_str(); }

 private:
  std::string msg;
};

}  // namespace hardware_interface
