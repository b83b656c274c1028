#include "class_loader/class_loader.hpp"

#include <dlfcn.h>

#include <mutex>
#include <set>

namespace class_loader {
namespace {

struct Class {
  std::string library, name, base;
  impl::Create create;
};

/** Registered classes. Registrations run before main(), so it is made at its first use. */
struct Registry {
  std::recursive_mutex mutex;
  std::vector<Class> classes;
  std::set<std::string> loaded;
  std::string loading;
};
Registry& registry() {
  static Registry* const registry = new Registry;
  return *registry;
}

#ifdef __APPLE__
const char* const kSuffix = ".dylib";
#else
const char* const kSuffix = ".so";
#endif

}  // namespace

namespace impl {

void registerClass(const char* class_name, const std::type_info& base, Create create) {
  Registry& known = registry();
  const std::lock_guard<std::recursive_mutex> lock(known.mutex);
  known.classes.push_back(Class{known.loading, class_name, base.name(), create});
}

Create findClass(const std::string& library, const std::string& class_name, const std::type_info& base) {
  Registry& known = registry();
  const std::lock_guard<std::recursive_mutex> lock(known.mutex);
  Create found = nullptr;  // the library's own, else one that is linked to the program
  for (const Class& one : known.classes)
    if (one.name == class_name && one.base == base.name()) {
      if (one.library == library) return one.create;
      if (one.library.empty() || library.empty()) found = one.create;
    }
  return found;
}

std::vector<std::string> classNames(const std::string& library, const std::type_info& base) {
  Registry& known = registry();
  const std::lock_guard<std::recursive_mutex> lock(known.mutex);
  std::vector<std::string> names;
  for (const Class& one : known.classes)
    if (one.base == base.name() && (one.library == library || one.library.empty() || library.empty()))
      names.push_back(one.name);
  return names;
}

void load(const std::string& library) {
  Registry& known = registry();
  const std::lock_guard<std::recursive_mutex> lock(known.mutex);
  if (known.loaded.count(library)) return;
  const std::string before = known.loading;
  known.loading = library;
  void* const handle = dlopen(library.c_str(), RTLD_LAZY | RTLD_GLOBAL);
  known.loading = before;
  if (!handle) throw LibraryLoadException("Could not load library (" + std::string(dlerror()) + ")");
  known.loaded.insert(library);
}

bool isLoaded(const std::string& library) {
  Registry& known = registry();
  const std::lock_guard<std::recursive_mutex> lock(known.mutex);
  return known.loaded.count(library) > 0;
}

}  // namespace impl

std::string systemLibraryPrefix() { return "lib"; }
std::string systemLibrarySuffix() { return kSuffix; }
std::string systemLibraryFormat(const std::string& library_name) { return "lib" + library_name + kSuffix; }

ClassLoader::ClassLoader(const std::string& library_path, bool ondemand_load_unload)
    : library_(library_path), is_on_demand_(ondemand_load_unload) {
  if (!is_on_demand_) loadLibrary();
}

void ClassLoader::loadLibrary() {
  impl::load(library_);
  ++count_;
}

int ClassLoader::unloadLibrary() {
  if (count_ > 0) --count_;
  return count_;
}

void* ClassLoader::create(const std::string& class_name, const std::type_info& base) {
  if (count_ == 0) loadLibrary();
  const impl::Create create = impl::findClass(library_, class_name, base);
  if (!create) throw CreateClassException("Could not create instance of type " + class_name + " of " + library_);
  return create();
}

}  // namespace class_loader
