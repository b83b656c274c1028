#pragma once

#include <string>
#include <vector>

#include <hardware_interface/interface_resources.h>

namespace hardware_interface {

/** Name, type and claims of a controller. */
struct ControllerInfo {
  std::string name, type;
  std::vector<InterfaceResources> claimed_resources;
};

}  // namespace hardware_interface
