// Layout of a message type, compiled for reading and writing.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "py_object.h"

namespace trundle::messages {

// Numbers first; kNumbers counts them.
enum class Kind : uint8_t {
  kBool,
  kInt8,
  kUInt8,
  kInt16,
  kUInt16,
  kInt32,
  kUInt32,
  kInt64,
  kUInt64,
  kFloat32,
  kFloat64,
  kString,
  kMessage,
  kPlaceholder,
};
constexpr size_t kNumbers = 11;
constexpr uint8_t kNumberBytes[kNumbers] = {1, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};

constexpr bool is_number(Kind kind) { return static_cast<size_t>(kind) < kNumbers; }
constexpr bool is_real(Kind kind) { return kind == Kind::kFloat32 || kind == Kind::kFloat64; }
constexpr size_t bytes_of(Kind number) { return kNumberBytes[static_cast<size_t>(number)]; }

constexpr int64_t kScalar = -1, kVariable = -2;

// Field as Python declares it: `count` is an array's length, kScalar or kVariable; `message` is the index of an earlier
// type.
struct FieldSpec {
  Object name;
  std::string type;
  int64_t count;
  size_t message;
};

struct Layout;

struct Field {
  Object name;  // interned
  Kind kind;
  int64_t count;
  const Layout* message;  // if kMessage
  uint64_t min_size;      // smallest size of an element [bytes]
};

struct Layout {
  Object type;
  std::vector<Field> fields;
  uint64_t min_size = 0;        // smallest size of a message [bytes]
  uint64_t empty_messages = 1;  // messages without bytes in one message, itself included
};

// Limit of messages without bytes in an array, and in a message beyond one for each byte: the size of the data does
// not limit their number.
constexpr uint64_t kMaxEmpty = 1024;

// Python type of arrays of numbers.
enum class Arrays : uint8_t {
  kNumpy,  // views of the bytes
  kPlain,  // as in genpy: bytes for uint8 and char, a list for bool, else a tuple
};

// Buffer that a stream is received into.
struct ReceiveBuffer {
  PyObject* room;  // free part, to receive into
  PyObject* whole;
  Py_ssize_t filled;  // bytes before `room`, the start of a frame
  uint32_t limit;     // longest content of a frame [bytes]
};

// Reads and writes one message type.
class MessageCodec {
 public:
  explicit MessageCodec(Arrays arrays = Arrays::kNumpy) : arrays_(arrays) {}
  MessageCodec(MessageCodec&&) = default;

  // A type comes after the types to which it refers, so that none contains itself; the last one is the type of the
  // message.
  void add(Object type, std::vector<FieldSpec> fields);

  // Returns `bytes`.
  Object write(PyObject* message) const;
  // Returns a tuple of `bytes`, the frame's length first; the first long array is a memoryview between them, not
  // copied.
  Object frame(PyObject* message) const;
  // Called with the whole frame of a message; with nothing if the frame is long.
  void write_short(PyObject* message, const std::function<void(std::string_view)>& use) const;
  Object read(PyObject* data) const;
  // Like the function `receive`, with decoded messages in place of their bytes; stops before an invalid one.
  Object receive(PyObject* recv_into, const ReceiveBuffer& buffer) const;

 private:
  Arrays arrays_;
  std::vector<std::unique_ptr<Layout>> layouts_;
};

// Call `recv_into(room)`; return (contents, parsed, count): a list of the contents of the whole frames at the buffer's
// start, their length in the buffer, and the number of bytes received.
Object receive(PyObject* recv_into, const ReceiveBuffer& buffer);

}  // namespace trundle::messages
