#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "class_loader/class_loader.hpp"

namespace class_loader {

/** Creates objects of the classes that several libraries register. */
class MultiLibraryClassLoader {
 public:
  explicit MultiLibraryClassLoader(bool enable_ondemand_loadunload) : is_on_demand_(enable_ondemand_loadunload) {}
  virtual ~MultiLibraryClassLoader() {}

  /** Object of a class that any of the libraries registers. */
  template <class Base>
  boost::shared_ptr<Base> createInstance(const std::string& class_name) {
    return loaderOfClass<Base>(class_name).template createInstance<Base>(class_name);
  }
  template <class Base>
  boost::shared_ptr<Base> createInstance(const std::string& class_name, const std::string& library_path) {
    return loaderOf(library_path).createInstance<Base>(class_name);
  }
  template <class Base>
  std::shared_ptr<Base> createSharedInstance(const std::string& class_name) {
    return loaderOfClass<Base>(class_name).template createSharedInstance<Base>(class_name);
  }
  template <class Base>
  std::shared_ptr<Base> createSharedInstance(const std::string& class_name, const std::string& library_path) {
    return loaderOf(library_path).createSharedInstance<Base>(class_name);
  }
  template <class Base>
  ClassLoader::UniquePtr<Base> createUniqueInstance(const std::string& class_name) {
    return loaderOfClass<Base>(class_name).template createUniqueInstance<Base>(class_name);
  }
  template <class Base>
  ClassLoader::UniquePtr<Base> createUniqueInstance(const std::string& class_name, const std::string& library_path) {
    return loaderOf(library_path).createUniqueInstance<Base>(class_name);
  }
  template <class Base>
  Base* createUnmanagedInstance(const std::string& class_name) {
    return loaderOfClass<Base>(class_name).template createUnmanagedInstance<Base>(class_name);
  }
  template <class Base>
  Base* createUnmanagedInstance(const std::string& class_name, const std::string& library_path) {
    return loaderOf(library_path).createUnmanagedInstance<Base>(class_name);
  }
  template <class Base>
  std::vector<std::string> getAvailableClasses() const {
    std::vector<std::string> names;
    for (const auto& entry : loaders_)
      for (const std::string& name : entry.second->getAvailableClasses<Base>()) names.push_back(name);
    return names;
  }
  template <class Base>
  std::vector<std::string> getAvailableClassesForLibrary(const std::string& library_path) const {
    return loaderOf(library_path).getAvailableClasses<Base>();
  }
  template <class Base>
  bool isClassAvailable(const std::string& class_name) const {
    for (const auto& entry : loaders_)
      if (entry.second->isClassAvailable<Base>(class_name)) return true;
    return false;
  }
  bool isLibraryAvailable(const std::string& library_path) const { return loaders_.count(library_path) > 0; }
  std::vector<std::string> getRegisteredLibraries() const;
  bool isOnDemandLoadUnloadEnabled() const { return is_on_demand_; }
  void loadLibrary(const std::string& library_path);
  /** Give a library back; the number of loads that remain is returned. */
  int unloadLibrary(const std::string& library_path);

 private:
  /** Throws CreateClassException, as loaderOfClass does. */
  ClassLoader& loaderOf(const std::string& library_path) const;
  template <class Base>
  ClassLoader& loaderOfClass(const std::string& class_name) const {
    for (const auto& entry : loaders_) {
      if (!entry.second->isLibraryLoaded()) entry.second->loadLibrary();
      if (entry.second->isClassAvailable<Base>(class_name)) return *entry.second;
    }
    throw CreateClassException("no library of this class loader has the class " + class_name);
  }

  bool is_on_demand_;
  std::map<std::string, std::shared_ptr<ClassLoader> > loaders_;
};

}  // namespace class_loader
