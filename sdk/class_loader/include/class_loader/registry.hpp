#pragma once

#include <string>
#include <typeinfo>
#include <vector>

namespace class_loader {
namespace impl {

typedef void* (*Create)();

/** Register a class of the library that is being loaded, or of the program; `create` returns a pointer to its base. */
void registerClass(const char* class_name, const std::type_info& base, Create create);
/** Function that creates a class of a library; null if there is none. "" is any library. */
Create findClass(const std::string& library, const std::string& class_name, const std::type_info& base);
std::vector<std::string> classNames(const std::string& library, const std::type_info& base);
/** Load a library, whose classes register themselves; it stays in memory. Throws LibraryLoadException. */
void load(const std::string& library);
/** Count a class loader that has loaded a library, or one that gave it back. */
void hold(const std::string& library);
void release(const std::string& library);
/** True if a class loader has the library. */
bool isLibraryLoadedByAnybody(const std::string& library);

template <class Derived, class Base>
void* create() {
  return static_cast<Base*>(new Derived);
}
/** Its constructor registers a class when the library is loaded. */
template <class Derived, class Base>
struct Registration {
  explicit Registration(const char* class_name) { registerClass(class_name, typeid(Base), &create<Derived, Base>); }
};

}  // namespace impl
}  // namespace class_loader
