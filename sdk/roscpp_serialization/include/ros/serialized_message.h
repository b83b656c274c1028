#pragma once

#include <boost/shared_array.hpp>
#include <boost/shared_ptr.hpp>
#include <cstddef>
#include <cstdint>
#include <typeinfo>

namespace ros {

/** Serialized message after its length, or, within a process, the message object. */
class SerializedMessage {
 public:
  boost::shared_array<uint8_t> buf;
  size_t num_bytes;
  uint8_t* message_start;
  boost::shared_ptr<void const> message;
  const std::type_info* type_info;

  SerializedMessage() : num_bytes(0), message_start(nullptr), type_info(nullptr) {}
  SerializedMessage(boost::shared_array<uint8_t> bytes, size_t size)
      : buf(bytes), num_bytes(size), message_start(bytes ? bytes.get() : nullptr), type_info(nullptr) {}
};

}  // namespace ros
