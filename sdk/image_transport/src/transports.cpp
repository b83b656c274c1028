#include "transports.h"

#include <dlfcn.h>
#include <image_transport/exception.h>
#include <image_transport/raw_publisher.h>
#include <image_transport/raw_subscriber.h>
#include <pluginlib/class_loader.hpp>

#include <algorithm>
#include <filesystem>

namespace image_transport {
namespace {

namespace fs = std::filesystem;

/** Library of the compressed transport beside this one; "" if the machine had no libjpeg for it. */
std::string compressedLibrary() {
  Dl_info info;
  if (!dladdr(reinterpret_cast<void*>(&createPublisher), &info)) return "";
  const fs::path path =
      fs::path(info.dli_fname).parent_path() / class_loader::systemLibraryFormat("compressed_image_transport");
  std::error_code error;
  return fs::exists(path, error) ? path.string() : "";
}

/** Plugins for a base class: of the kit, and of packages. */
template <class Plugin>
class Plugins {
 public:
  Plugins(const char* base, const char* suffix)
      : suffix_(suffix), exported_("image_transport", base), compressed_(compressedLibrary()) {}

  std::vector<std::string> names() const {
    std::vector<std::string> names(1, "raw");
    if (!compressed_.empty()) names.push_back("compressed");
    for (const std::string& lookup_name : exported_.getDeclaredClasses()) {
      std::string name = lookup_name.substr(lookup_name.rfind('/') + 1);
      if (name.size() > suffix_.size() && name.compare(name.size() - suffix_.size(), suffix_.size(), suffix_) == 0)
        name.resize(name.size() - suffix_.size());
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
  }
  /** True if a transport's library exists. */
  bool isThere(const std::string& transport) const {
    return transport == "raw" || (transport == "compressed" && !compressed_.empty()) ||
           !exported_.getClassLibraryPath(Plugin::getLookupName(transport)).empty();
  }
  boost::shared_ptr<Plugin> create(const std::string& transport, const char* compressed_class) {
    try {
      if (transport == "compressed" && !compressed_.empty()) {
        class_loader::impl::load(compressed_);
        const class_loader::impl::Create found =
            class_loader::impl::findClass(compressed_, compressed_class, typeid(Plugin));
        if (found) return boost::shared_ptr<Plugin>(static_cast<Plugin*>(found()));
      }
      return exported_.createInstance(Plugin::getLookupName(transport));
    } catch (const std::runtime_error& error) {
      std::string what = error.what();
      if (transport == "compressed")
        what +=
            "\nTrundle's development kit has it where the headers of libjpeg and libpng were installed when "
            "catkin_make compiled the kit (apt install libjpeg-dev libpng-dev)";
      throw TransportLoadException(transport, what);
    }
  }

 private:
  std::string suffix_;
  pluginlib::ClassLoader<Plugin> exported_;
  std::string compressed_;
};

Plugins<PublisherPlugin>& publishers() {
  static Plugins<PublisherPlugin> plugins("image_transport::PublisherPlugin", "_pub");
  return plugins;
}

Plugins<SubscriberPlugin>& subscribers() {
  static Plugins<SubscriberPlugin> plugins("image_transport::SubscriberPlugin", "_sub");
  return plugins;
}

}  // namespace

std::vector<std::string> publisherTransports() {
  std::vector<std::string> names;
  for (const std::string& name : publishers().names())
    if (publishers().isThere(name)) names.push_back(name);
  return names;
}

std::vector<std::string> declaredTransports() {
  std::vector<std::string> names = publishers().names();
  for (const std::string& name : subscribers().names())
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

boost::shared_ptr<PublisherPlugin> createPublisher(const std::string& transport) {
  if (transport == "raw") return boost::make_shared<RawPublisher>();
  return publishers().create(transport, "compressed_image_transport::CompressedPublisher");
}

boost::shared_ptr<SubscriberPlugin> createSubscriber(const std::string& transport) {
  if (transport == "raw") return boost::make_shared<RawSubscriber>();
  return subscribers().create(transport, "compressed_image_transport::CompressedSubscriber");
}

}  // namespace image_transport
