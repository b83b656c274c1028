#include "class_loader/class_loader.hpp"
#include "class_loader/multi_library_class_loader.hpp"

#include <dlfcn.h>

#include <map>
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
  std::map<std::string, int> holders;
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

void hold(const std::string& library) {
  Registry& known = registry();
  const std::lock_guard<std::recursive_mutex> lock(known.mutex);
  ++known.holders[library];
}

void release(const std::string& library) {
  Registry& known = registry();
  const std::lock_guard<std::recursive_mutex> lock(known.mutex);
  if (known.holders[library] > 0) --known.holders[library];
}

bool isLibraryLoadedByAnybody(const std::string& library) {
  Registry& known = registry();
  const std::lock_guard<std::recursive_mutex> lock(known.mutex);
  const auto found = known.holders.find(library);
  return found != known.holders.end() && found->second > 0;
}

Loads::~Loads() {
  if (count > 0) release(library);
}

void Loads::add() {
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  load(library);
  if (count++ == 0) hold(library);
}

int Loads::remove() {
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  if (count > 0 && --count == 0) release(library);
  return count;
}

void Loads::forgetObject() {
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  if (--objects > 0 || !isOnDemand || hasUnmanaged) return;
  while (remove() > 0) {}
}

}  // namespace impl

std::string systemLibraryPrefix() { return "lib"; }
std::string systemLibrarySuffix() { return kSuffix; }
std::string systemLibraryFormat(const std::string& library_name) { return "lib" + library_name + kSuffix; }

ClassLoader::ClassLoader(const std::string& library_path, bool ondemand_load_unload)
    : loads_(std::make_shared<impl::Loads>(library_path, ondemand_load_unload)) {
  if (!ondemand_load_unload) loadLibrary();
}

void* ClassLoader::create(const std::string& class_name, const std::type_info& base, bool is_managed) {
  const std::lock_guard<std::recursive_mutex> lock(loads_->mutex);
  if (loads_->count == 0 && loads_->isOnDemand) loads_->add();
  const impl::Create create =
      loads_->count > 0 ? impl::findClass(loads_->library, class_name, base) : static_cast<impl::Create>(nullptr);
  if (!create)
    throw CreateClassException("Could not create instance of type " + class_name + " of " + loads_->library +
                               (loads_->count > 0 ? "" : ", which is not loaded"));
  void* const object = create();
  if (is_managed) ++loads_->objects;
  else loads_->hasUnmanaged = true;
  return object;
}

void MultiLibraryClassLoader::loadLibrary(const std::string& library_path) {
  if (loaders_.count(library_path) == 0)
    loaders_[library_path] = std::make_shared<ClassLoader>(library_path, is_on_demand_);
}

int MultiLibraryClassLoader::unloadLibrary(const std::string& library_path) {
  const auto found = loaders_.find(library_path);
  if (found == loaders_.end()) return 0;
  const int remaining = found->second->unloadLibrary();
  if (remaining == 0) loaders_.erase(found);
  return remaining;
}

std::vector<std::string> MultiLibraryClassLoader::getRegisteredLibraries() const {
  std::vector<std::string> libraries;
  for (const auto& entry : loaders_) libraries.push_back(entry.first);
  return libraries;
}

ClassLoader& MultiLibraryClassLoader::loaderOf(const std::string& library_path) const {
  const auto found = loaders_.find(library_path);
  if (found == loaders_.end())
    throw CreateClassException("no library " + library_path + " was loaded by this class loader");
  return *found->second;
}

}  // namespace class_loader
