// Short frames that are written to sockets at once.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "message_layout.h"

namespace trundle::messages {

// Socket of a send queue, written to with the GIL held: a write and its bookkeeping are one step for all threads, and a
// short write takes no longer than releasing the GIL. The queue opens it while nothing else is being or to be written.
class DirectSocket {
 public:
  explicit DirectSocket(int fd) : fd_(fd) {}

  bool is_open = false;
  uint64_t bytes_sent = 0, frames_sent = 0;
  // Rest of the last frame that the kernel did not accept; the socket is closed, and the queue sends the rest.
  std::string rest;

  void write(std::string_view frame);

 private:
  int fd_;
};

// Sends messages of one type to all sockets of a topic, from any thread.
class DirectSender {
 public:
  // codec: null for a type that serializes itself, whose messages are not sent here.
  DirectSender(Object type, std::shared_ptr<const MessageCodec> codec, bool has_header)
      : type_(std::move(type)), codec_(std::move(codec)), has_header_(has_header) {}

  // True while messages may be sent directly.
  bool is_active = false;
  // Number of messages; the next one's is written to its header.
  uint32_t sequence = 0;
  std::vector<std::shared_ptr<DirectSocket>> sockets;

  enum class Sent { kNothing, kWhole, kInPart };
  // Send a message, a call's only argument; nothing if it is long, of another type or invalid.
  Sent send(PyObject* arguments, PyObject* keywords);

 private:
  bool is_open() const;
  static void set_sequence(PyObject* message, uint32_t number);

  const Object type_;
  const std::shared_ptr<const MessageCodec> codec_;
  const bool has_header_;
  bool is_long_ = false;  // the last messages were long, so serializing the next one here may be wasted
};

}  // namespace trundle::messages
