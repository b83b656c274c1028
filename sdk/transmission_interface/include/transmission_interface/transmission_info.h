#pragma once

#include <string>
#include <vector>

namespace transmission_interface {

/** Joint in a <transmission>; the element's text is XML. */
struct JointInfo {
  std::string name_;
  std::vector<std::string> hardware_interfaces_;
  std::string role_, xml_element_;
};

struct ActuatorInfo {
  std::string name_;
  std::vector<std::string> hardware_interfaces_;
  std::string xml_element_;
};

struct TransmissionInfo {
  std::string name_, type_;
  std::vector<JointInfo> joints_;
  std::vector<ActuatorInfo> actuators_;
};

}  // namespace transmission_interface
