#include "resource_retriever/retriever.h"

#include <ros/package.h>

#include <fstream>

namespace resource_retriever {
namespace {

constexpr std::streamoff kMaxBytes = std::streamoff{1} << 30;
const std::string kPackage = "package://", kFile = "file://";

/** Path of the file that a URL names. */
std::string pathOf(const std::string& url) {
  if (url.compare(0, kFile.size(), kFile) == 0) return url.substr(kFile.size());
  if (url.compare(0, kPackage.size(), kPackage) == 0) {
    const size_t slash = url.find('/', kPackage.size());
    if (slash == std::string::npos) throw Exception(url, "a file of the package is missing, as in package://NAME/FILE");
    const std::string name = url.substr(kPackage.size(), slash - kPackage.size());
    const std::string folder = ros::package::getPath(name);
    if (folder.empty()) throw Exception(url, "there is no package '" + name + "'");
    return folder + url.substr(slash);
  }
  if (url.find("://") != std::string::npos)
    throw Exception(url, "Trundle's development kit reads package:// and file:// alone");
  return url;
}

}  // namespace

MemoryResource Retriever::get(const std::string& url) {
  const std::string path = pathOf(url);
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? std::streamoff{file.tellg()} : -1;
  if (size < 0) throw Exception(url, "cannot read " + path);
  if (size > kMaxBytes) throw Exception(url, path + " is larger than 1 GiB");
  MemoryResource resource;
  resource.size = static_cast<uint32_t>(size);
  resource.data.reset(new uint8_t[resource.size]);
  file.seekg(0);
  if (!file.read(reinterpret_cast<char*>(resource.data.get()), size)) throw Exception(url, "cannot read " + path);
  return resource;
}

}  // namespace resource_retriever
