#pragma once

#include <ros/console.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <hardware_interface/hardware_interface.h>
#include <hardware_interface/internal/demangle_symbol.h>
#include <hardware_interface/internal/resource_manager.h>

namespace hardware_interface {

/** Interfaces by type, of itself and of other managers that it combines. */
class InterfaceManager {
 public:
  virtual ~InterfaceManager() {}

  template <class T>
  void registerInterface(T* iface) {
    const std::string type = internal::demangledTypeName<T>();
    if (entries_.count(type)) ROS_WARN_STREAM("Replacing previously registered interface '" << type << "'.");
    Entry& entry = entries_[type];
    entry.interface = iface;
    entry.resources = resourcesOf(iface, std::is_base_of<ResourceManagerBase, T>());
  }
  /** Add the interfaces of another manager, which has to live as long as this one. */
  void registerInterfaceManager(InterfaceManager* manager) { managers_.push_back(manager); }

  /** Interface of a type, null if there is none. If several managers have it, one with all their handles. */
  template <class T>
  T* get() {
    const std::string type = internal::demangledTypeName<T>();
    std::vector<T*> found;
    const auto own = entries_.find(type);
    if (own != entries_.end()) found.push_back(static_cast<T*>(own->second.interface));
    for (InterfaceManager* const manager : managers_)
      if (T* const theirs = manager->get<T>()) found.push_back(theirs);
    if (found.size() < 2) return found.empty() ? nullptr : found.front();
    return combine<T>(type, found, std::is_base_of<ResourceManagerBase, T>());
  }

  /** Types of the interfaces. */
  std::vector<std::string> getNames() const {
    std::vector<std::string> names;
    for (const auto& entry : entries_) names.push_back(entry.first);
    for (const InterfaceManager* const manager : managers_)
      for (const std::string& name : manager->getNames())
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    return names;
  }
  /** Names of the handles of an interface of a type. */
  std::vector<std::string> getInterfaceResources(std::string iface_type) const {
    std::vector<std::string> names;
    const auto own = entries_.find(iface_type);
    if (own != entries_.end() && own->second.resources) names = own->second.resources();
    for (const InterfaceManager* const manager : managers_) {
      const std::vector<std::string> theirs = manager->getInterfaceResources(iface_type);
      names.insert(names.end(), theirs.begin(), theirs.end());
    }
    return names;
  }

 protected:
  typedef std::vector<InterfaceManager*> InterfaceManagerVector;
  InterfaceManagerVector& combinedManagers() { return managers_; }

 private:
  struct Entry {
    void* interface = nullptr;
    std::function<std::vector<std::string>()> resources;
  };
  struct Combined {
    std::shared_ptr<void> interface;
    std::size_t count;
  };

  template <class T>
  static std::function<std::vector<std::string>()> resourcesOf(T* iface, std::true_type) {
    return [iface] { return iface->getNames(); };
  }
  template <class T>
  static std::function<std::vector<std::string>()> resourcesOf(T*, std::false_type) {
    return nullptr;
  }
  template <class T>
  T* combine(const std::string& type, std::vector<T*>& found, std::true_type) {
    std::size_t count = 0;
    for (T* const one : found) count += one->getNames().size();
    Combined& combined = combined_[type];
    if (!combined.interface || combined.count != count) {
      const std::shared_ptr<T> made = std::make_shared<T>();
      std::vector<typename T::resource_manager_type*> managers(found.begin(), found.end());
      T::concatManagers(managers, made.get());
      combined = Combined{made, count};
      kept_.push_back(made);
    }
    return static_cast<T*>(combined.interface.get());
  }
  template <class T>
  T* combine(const std::string& type, std::vector<T*>&, std::false_type) {
    ROS_ERROR_STREAM("Several managers have the interface " << type << ", which has no handles to combine.");
    return nullptr;
  }

  std::map<std::string, Entry> entries_;
  InterfaceManagerVector managers_;
  std::map<std::string, Combined> combined_;
  std::vector<std::shared_ptr<void> > kept_;
};

}  // namespace hardware_interface
