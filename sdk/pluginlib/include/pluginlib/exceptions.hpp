#pragma once

#include <stdexcept>
#include <string>

namespace pluginlib {

class PluginlibException : public std::runtime_error {
 public:
  explicit PluginlibException(const std::string& what) : std::runtime_error(what) {}
};
class LibraryLoadException : public PluginlibException {
 public:
  explicit LibraryLoadException(const std::string& what) : PluginlibException(what) {}
};
class ClassLoaderException : public PluginlibException {
 public:
  explicit ClassLoaderException(const std::string& what) : PluginlibException(what) {}
};
class LibraryUnloadException : public PluginlibException {
 public:
  explicit LibraryUnloadException(const std::string& what) : PluginlibException(what) {}
};
class CreateClassException : public PluginlibException {
 public:
  explicit CreateClassException(const std::string& what) : PluginlibException(what) {}
};
class InvalidXMLException : public PluginlibException {
 public:
  explicit InvalidXMLException(const std::string& what) : PluginlibException(what) {}
};

}  // namespace pluginlib
