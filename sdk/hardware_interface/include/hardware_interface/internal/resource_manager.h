#pragma once

#include <ros/console.h>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <hardware_interface/internal/demangle_symbol.h>

namespace hardware_interface {

class ResourceManagerBase {
 public:
  virtual ~ResourceManagerBase() {}
};

/** Handles by the names of their resources. */
template <class ResourceHandle>
class ResourceManager : public ResourceManagerBase {
 public:
  typedef ResourceManager<ResourceHandle> resource_manager_type;
  typedef ResourceHandle ResourceHandleType;

  virtual ~ResourceManager() {}

  std::vector<std::string> getNames() const {
    std::vector<std::string> names;
    for (const auto& entry : resource_map_) names.push_back(entry.first);
    return names;
  }
  /** Add a handle, in place of one of the same name. */
  void registerHandle(const ResourceHandle& handle) {
    const auto added = resource_map_.insert(std::make_pair(handle.getName(), handle));
    if (added.second) return;
    ROS_WARN_STREAM("Replacing previously registered handle '" << handle.getName() << "' in '"
                                                               << internal::demangledTypeName(*this) << "'.");
    resource_map_.erase(added.first);
    resource_map_.insert(std::make_pair(handle.getName(), handle));
  }
  /** Throws std::logic_error if there is none of this name. */
  ResourceHandle getHandle(const std::string& name) {
    const auto found = resource_map_.find(name);
    if (found == resource_map_.end())
      throw std::logic_error("Could not find resource '" + name + "' in '" + internal::demangledTypeName(*this) + "'.");
    return found->second;
  }
  /** Add the handles of other managers. */
  static void concatManagers(std::vector<resource_manager_type*>& managers, resource_manager_type* result) {
    for (resource_manager_type* const manager : managers)
      for (const std::string& name : manager->getNames()) result->registerHandle(manager->getHandle(name));
  }

 protected:
  std::map<std::string, ResourceHandle> resource_map_;
};

}  // namespace hardware_interface
