#pragma once

#include <stdexcept>
#include <string>

namespace class_loader {

class ClassLoaderException : public std::runtime_error {
 public:
  explicit ClassLoaderException(const std::string& what) : std::runtime_error(what) {}
};
/** A library that cannot be loaded. */
class LibraryLoadException : public ClassLoaderException {
 public:
  explicit LibraryLoadException(const std::string& what) : ClassLoaderException(what) {}
};
class LibraryUnloadException : public ClassLoaderException {
 public:
  explicit LibraryUnloadException(const std::string& what) : ClassLoaderException(what) {}
};
/** A class that is not registered. */
class CreateClassException : public ClassLoaderException {
 public:
  explicit CreateClassException(const std::string& what) : ClassLoaderException(what) {}
};

}  // namespace class_loader
