#pragma once

#include <ros/console.h>
#include <ros/package.h>

#include <boost/shared_ptr.hpp>
#include <class_loader/class_loader.hpp>
#include <map>
#include <string>
#include <vector>

#include "pluginlib/exceptions.hpp"

namespace pluginlib {

/** Class as a plugin description has it. */
struct PluginClass {
  std::string lookup_name, derived_class, base_class, package, description, library, xml;
};

/** Finds the plugins that packages export for a base class, and their libraries. */
class Plugins {
 public:
  Plugins(const std::string& package, const std::string& base_class, const std::string& attribute,
          const std::vector<std::string>& xml_paths);

  std::vector<std::string> getPluginXmlPaths() const { return xml_paths_; }
  std::vector<std::string> getDeclaredClasses() const;
  std::vector<std::string> getRegisteredLibraries() const;
  bool isClassAvailable(const std::string& lookup_name) const { return classes_.count(lookup_name) > 0; }
  bool isClassLoaded(const std::string& lookup_name) const;
  std::string getClassType(const std::string& lookup_name) const { return get(lookup_name).derived_class; }
  std::string getClassDescription(const std::string& lookup_name) const { return get(lookup_name).description; }
  std::string getClassPackage(const std::string& lookup_name) const { return get(lookup_name).package; }
  std::string getPluginManifestPath(const std::string& lookup_name) const { return get(lookup_name).xml; }
  /** Path of a class's library; "" if there is no such file. */
  std::string getClassLibraryPath(const std::string& lookup_name) const;
  /** Last part of a lookup name. */
  std::string getName(const std::string& lookup_name) const {
    return lookup_name.substr(lookup_name.find_last_of("/:") + 1);
  }
  std::string getBaseClassType() const { return base_class_; }
  void loadLibraryForClass(const std::string& lookup_name);
  int unloadLibraryForClass(const std::string& lookup_name);
  /** Read the descriptions again. */
  void refreshDeclaredClasses();

 protected:
  ~Plugins() {}
  void* create(const std::string& lookup_name, const std::type_info& base);

 private:
  PluginClass get(const std::string& lookup_name) const;
  void read(const std::string& package, const std::string& xml);
  std::string unknown(const std::string& lookup_name) const;

  std::string package_, base_class_, attribute_;
  std::vector<std::string> given_paths_, xml_paths_;
  std::map<std::string, PluginClass> classes_;
  std::map<std::string, int> loads_;
};

template <class T>
using UniquePtr = std::unique_ptr<T, std::function<void(T*)> >;

/** Creates objects of classes that packages export as plugins for class T. */
template <class T>
class ClassLoader : public Plugins {
 public:
  /** `package`: the base class's, after which the tags in <export> are named; `base_class`: with namespace. */
  ClassLoader(const std::string& package, const std::string& base_class, const std::string& attrib_name = "plugin",
              const std::vector<std::string>& plugin_xml_paths = std::vector<std::string>())
      : Plugins(package, base_class, attrib_name, plugin_xml_paths) {}

  /** Object of a class, by its name in the description. Throws LibraryLoadException or CreateClassException. */
  boost::shared_ptr<T> createInstance(const std::string& lookup_name) {
    return boost::shared_ptr<T>(createUnmanagedInstance(lookup_name));
  }
  std::shared_ptr<T> createSharedInstance(const std::string& lookup_name) {
    return std::shared_ptr<T>(createUnmanagedInstance(lookup_name));
  }
  UniquePtr<T> createUniqueInstance(const std::string& lookup_name) {
    return UniquePtr<T>(createUnmanagedInstance(lookup_name), [](T* object) { delete object; });
  }
  T* createUnmanagedInstance(const std::string& lookup_name) { return static_cast<T*>(create(lookup_name, typeid(T))); }
};

}  // namespace pluginlib
