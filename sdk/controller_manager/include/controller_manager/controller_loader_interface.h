#pragma once

#include <memory>
#include <string>
#include <vector>

#include <controller_interface/controller_base.h>

namespace controller_manager {

/** Creates controllers by the names of their types. */
class ControllerLoaderInterface {
 public:
  explicit ControllerLoaderInterface(const std::string& name) : name_(name) {}
  virtual ~ControllerLoaderInterface() {}
  virtual controller_interface::ControllerBaseSharedPtr createInstance(const std::string& lookup_name) = 0;
  virtual std::vector<std::string> getDeclaredClasses() = 0;
  virtual void reload() = 0;
  const std::string& getName() { return name_; }

 private:
  const std::string name_;
};
typedef std::shared_ptr<ControllerLoaderInterface> ControllerLoaderInterfaceSharedPtr;

}  // namespace controller_manager
