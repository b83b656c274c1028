#pragma once

#include <exception>
#include <string>

namespace transmission_interface {

class TransmissionInterfaceException : public std::exception {
 public:
  explicit TransmissionInterfaceException(const std::string& message) : msg(message) {}
  virtual ~TransmissionInterfaceException() throw() {}
  virtual const char* what() const throw() { return msg.c_str(); }

 private:
  std::string msg;
};

}  // namespace transmission_interface
