#pragma once

#include <boost/shared_ptr.hpp>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "class_loader/exceptions.hpp"
#include "class_loader/register_macro.hpp"

namespace class_loader {

/** Prefix and suffix of the machine's libraries: "lib", ".so". */
std::string systemLibraryPrefix();
std::string systemLibrarySuffix();
std::string systemLibraryFormat(const std::string& library_name);

namespace impl {

/** Library of a class loader, and how often it was loaded; the objects of its classes share it. */
struct Loads {
  Loads(const std::string& path, bool is_on_demand) : library(path), isOnDemand(is_on_demand) {}
  ~Loads();
  void add();
  int remove();
  void forgetObject();

  const std::string library;
  const bool isOnDemand;
  std::recursive_mutex mutex;
  int count = 0, objects = 0;
  bool hasUnmanaged = false;
};

}  // namespace impl

/** Creates objects of the classes that a library registers. On demand, it is loaded for the first object, and given back
 * with the last. */
class ClassLoader {
 public:
  template <class Base>
  using DeleterType = std::function<void(Base*)>;
  template <class Base>
  using UniquePtr = std::unique_ptr<Base, DeleterType<Base> >;

  explicit ClassLoader(const std::string& library_path, bool ondemand_load_unload = false);
  virtual ~ClassLoader() {}

  template <class Base>
  boost::shared_ptr<Base> createInstance(const std::string& derived_class_name) {
    return boost::shared_ptr<Base>(createManaged<Base>(derived_class_name), deleter<Base>());
  }
  template <class Base>
  std::shared_ptr<Base> createSharedInstance(const std::string& derived_class_name) {
    return std::shared_ptr<Base>(createManaged<Base>(derived_class_name), deleter<Base>());
  }
  template <class Base>
  UniquePtr<Base> createUniqueInstance(const std::string& derived_class_name) {
    return UniquePtr<Base>(createManaged<Base>(derived_class_name), deleter<Base>());
  }
  /** The caller deletes it, and the library is never given back by itself. */
  template <class Base>
  Base* createUnmanagedInstance(const std::string& derived_class_name) {
    return static_cast<Base*>(create(derived_class_name, typeid(Base), false));
  }
  template <class Base>
  std::vector<std::string> getAvailableClasses() const {
    return impl::classNames(loads_->library, typeid(Base));
  }
  template <class Base>
  bool isClassAvailable(const std::string& class_name) const {
    return impl::findClass(loads_->library, class_name, typeid(Base)) != nullptr;
  }
  const std::string& getLibraryPath() const { return loads_->library; }
  bool isLibraryLoaded() const { return loads_->count > 0; }
  bool isLibraryLoadedByAnyClassloader() const { return impl::isLibraryLoadedByAnybody(loads_->library); }
  bool isOnDemandLoadUnloadEnabled() const { return loads_->isOnDemand; }
  void loadLibrary() { loads_->add(); }
  /** Give the library back; the number of loads that remain is returned. */
  int unloadLibrary() { return loads_->remove(); }

 private:
  void* create(const std::string& class_name, const std::type_info& base, bool is_managed);
  template <class Base>
  Base* createManaged(const std::string& class_name) {
    return static_cast<Base*>(create(class_name, typeid(Base), true));
  }
  template <class Base>
  DeleterType<Base> deleter() const {
    const std::shared_ptr<impl::Loads> loads = loads_;
    return [loads](Base* object) {
      delete object;
      loads->forgetObject();
    };
  }

  std::shared_ptr<impl::Loads> loads_;
};

}  // namespace class_loader
