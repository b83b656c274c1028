#include "control_kit.h"

#include <stdexcept>

#ifndef _WIN32
#include <dlfcn.h>
#endif

namespace trundle {

#ifdef _WIN32

std::uintptr_t open_control_library(const std::string&) {
  throw std::runtime_error("compiled controllers are not run on Windows");
}
const TrundleControlKit* control_kit_of(std::uintptr_t) { return nullptr; }
std::string kit_folder_of(std::uintptr_t) { return ""; }

#else

namespace {

// Every plugin of pluginlib uses it: class_loader::impl::registerClass(const char*, const std::type_info&, Create).
constexpr const char* kRegister = "_ZN12class_loader4impl13registerClassEPKcRKSt9type_infoPFPvvE";

void* open_library(const std::string& file) {
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (library) return library;
  const char* error = ::dlerror();
  throw std::runtime_error(error ? error : "it cannot be opened");
}

std::string file_of_register(std::uintptr_t library) {
  Dl_info where;
  void* used = ::dlsym(reinterpret_cast<void*>(library), kRegister);
  if (!used || !::dladdr(used, &where) || !where.dli_fname)
    throw std::runtime_error("it is no plugin that was compiled with Trundle's development kit");
  return where.dli_fname;
}

}  // namespace

std::uintptr_t open_control_library(const std::string& file) {
  return reinterpret_cast<std::uintptr_t>(open_library(file));
}

std::string kit_folder_of(std::uintptr_t library) {
  const std::string file = file_of_register(library);
  return file.substr(0, file.rfind('/'));
}

const TrundleControlKit* control_kit_of(std::uintptr_t library) {
  const std::string file = file_of_register(library);
  void* kit = open_library(file.substr(0, file.rfind('/')) + "/libcontroller_interface" + file.substr(file.rfind('.')));
  const auto get = reinterpret_cast<const TrundleControlKit* (*)()>(::dlsym(kit, "trundle_control_kit"));
  const TrundleControlKit* functions = get ? get() : nullptr;
  if (!functions || functions->abi != TRUNDLE_CONTROL_ABI)
    throw std::runtime_error("it was compiled with another release of Trundle; compile it again");
  return functions;
}

#endif

}  // namespace trundle
