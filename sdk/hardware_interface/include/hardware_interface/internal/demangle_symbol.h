#pragma once

#include <cxxabi.h>

#include <cstdlib>
#include <string>
#include <typeinfo>

namespace hardware_interface {
namespace internal {

/** Name of a type as in its source, of the name that the compiler gives it. */
inline std::string demangleSymbol(const char* name) {
  int status = 0;
  char* const text = abi::__cxa_demangle(name, nullptr, nullptr, &status);
  const std::string result = status == 0 && text ? text : name;
  std::free(text);
  return result;
}
template <class T>
std::string demangledTypeName() {
  return demangleSymbol(typeid(T).name());
}
template <class T>
std::string demangledTypeName(const T& value) {
  return demangleSymbol(typeid(value).name());
}

}  // namespace internal
}  // namespace hardware_interface
