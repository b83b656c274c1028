#pragma once

#include <set>
#include <string>

namespace hardware_interface {

/** Resources of one interface that a controller uses. */
struct InterfaceResources {
  InterfaceResources() {}
  InterfaceResources(const std::string& hw_iface, const std::set<std::string>& res)
      : hardware_interface(hw_iface), resources(res) {}
  /** Type of the interface. */
  std::string hardware_interface;
  std::set<std::string> resources;
};

}  // namespace hardware_interface
