#pragma once

#include <boost/shared_array.hpp>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace resource_retriever {

class Exception : public std::runtime_error {
 public:
  Exception(const std::string& file, const std::string& error_msg)
      : std::runtime_error("Error retrieving file [" + file + "]: " + error_msg) {}
};

/** Contents of a file. */
struct MemoryResource {
  MemoryResource() : size(0) {}
  boost::shared_array<uint8_t> data;
  uint32_t size;
};

/** Reads files by URL: package://PACKAGE/PATH, file:///PATH or a path. */
class Retriever {
 public:
  /** Contents of a file of at most 1 GiB; throws Exception. Nothing is downloaded. */
  MemoryResource get(const std::string& url);
};

}  // namespace resource_retriever
