#pragma once

#include <boost/shared_ptr.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "class_loader/exceptions.hpp"
#include "class_loader/register_macro.hpp"

namespace class_loader {

/** Prefix and suffix of the machine's libraries: "lib", ".so". */
std::string systemLibraryPrefix();
std::string systemLibrarySuffix();
std::string systemLibraryFormat(const std::string& library_name);

/** Creates objects of the classes that a library registers. */
class ClassLoader {
 public:
  template <class Base>
  using DeleterType = std::function<void(Base*)>;
  template <class Base>
  using UniquePtr = std::unique_ptr<Base, DeleterType<Base> >;

  explicit ClassLoader(const std::string& library_path, bool ondemand_load_unload = false);

  template <class Base>
  boost::shared_ptr<Base> createInstance(const std::string& derived_class_name) {
    return boost::shared_ptr<Base>(createUnmanagedInstance<Base>(derived_class_name));
  }
  template <class Base>
  std::shared_ptr<Base> createSharedInstance(const std::string& derived_class_name) {
    return std::shared_ptr<Base>(createUnmanagedInstance<Base>(derived_class_name));
  }
  template <class Base>
  UniquePtr<Base> createUniqueInstance(const std::string& derived_class_name) {
    return UniquePtr<Base>(createUnmanagedInstance<Base>(derived_class_name), [](Base* object) { delete object; });
  }
  template <class Base>
  Base* createUnmanagedInstance(const std::string& derived_class_name) {
    return static_cast<Base*>(create(derived_class_name, typeid(Base)));
  }
  template <class Base>
  std::vector<std::string> getAvailableClasses() const {
    return impl::classNames(library_, typeid(Base));
  }
  template <class Base>
  bool isClassAvailable(const std::string& class_name) const {
    return impl::findClass(library_, class_name, typeid(Base)) != nullptr;
  }
  const std::string& getLibraryPath() const { return library_; }
  bool isLibraryLoaded() const { return count_ > 0; }
  bool isLibraryLoadedByAnyClassloader() const { return impl::isLoaded(library_); }
  bool isOnDemandLoadUnloadEnabled() const { return is_on_demand_; }
  void loadLibrary();
  /** Give the library back; the number of loads that remain is returned. */
  int unloadLibrary();

 private:
  void* create(const std::string& class_name, const std::type_info& base);

  std::string library_;
  bool is_on_demand_;
  int count_ = 0;
};

}  // namespace class_loader
