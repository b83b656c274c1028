#pragma once

#include <pluginlib/class_loader.hpp>

#include <memory>
#include <string>
#include <vector>

#include <controller_manager/controller_loader_interface.h>

namespace controller_manager {

/** Creates the controllers that packages export as plugins. */
template <class T>
class ControllerLoader : public ControllerLoaderInterface {
 public:
  ControllerLoader(const std::string& package, const std::string& base_class)
      : ControllerLoaderInterface(base_class), package_(package), base_class_(base_class) {
    reload();
  }
  controller_interface::ControllerBaseSharedPtr createInstance(const std::string& lookup_name) override {
    return loader_->createSharedInstance(lookup_name);
  }
  std::vector<std::string> getDeclaredClasses() override { return loader_->getDeclaredClasses(); }
  void reload() override { loader_.reset(new pluginlib::ClassLoader<T>(package_, base_class_)); }

 private:
  const std::string package_, base_class_;
  std::unique_ptr<pluginlib::ClassLoader<T> > loader_;
};

}  // namespace controller_manager
