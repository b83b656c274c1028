#pragma once

#include <string>

#include <hardware_interface/hardware_interface.h>
#include <hardware_interface/internal/resource_manager.h>

namespace hardware_interface {

/** Resources that are claimed by whoever gets a handle. */
struct ClaimResources {
  static void claim(HardwareInterface* hw, const std::string& name) { hw->claim(name); }
};
/** Resources that any number of controllers may use. */
struct DontClaimResources {
  static void claim(HardwareInterface*, const std::string&) {}
};

/** Interface with handles; its policy says whether getHandle claims the resource. */
template <class ResourceHandle, class ClaimPolicy = DontClaimResources>
class HardwareResourceManager : public HardwareInterface, public ResourceManager<ResourceHandle> {
 public:
  /** Throws HardwareInterfaceException if there is none of this name. */
  ResourceHandle getHandle(const std::string& name) {
    try {
      const ResourceHandle handle = this->ResourceManager<ResourceHandle>::getHandle(name);
      ClaimPolicy::claim(this, name);
      return handle;
    } catch (const std::logic_error& error) {
      throw HardwareInterfaceException(error.what());
    }
  }
};

}  // namespace hardware_interface
