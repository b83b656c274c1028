// What a message type looks like, ready to be written and read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "wire_object.h"

namespace trundle::wire {

// In this order: numbers, then the others.
enum class Kind : uint8_t {
  kBool, kInt8, kUInt8, kInt16, kUInt16, kInt32, kUInt32, kInt64, kUInt64, kFloat32, kFloat64,
  kString, kMessage, kNothing,
};
constexpr size_t kNumbers = 11;
constexpr uint8_t kNumberBytes[kNumbers] = {1, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};

constexpr bool is_number(Kind kind) { return static_cast<size_t>(kind) < kNumbers; }
constexpr bool is_real(Kind kind) { return kind == Kind::kFloat32 || kind == Kind::kFloat64; }
constexpr size_t bytes_of(Kind number) { return kNumberBytes[static_cast<size_t>(number)]; }

constexpr int64_t kOne = -1, kAny = -2;

// A field as it is told: `count` is how many there are, or kOne or kAny; `message` the place of a type told before.
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
  const Layout* message;  // of kMessage
  uint64_t least;         // bytes of an element
};

struct Layout {
  Object type;
  std::vector<Field> fields;
  uint64_t least = 0;     // bytes of a message
  uint64_t messages = 1;  // in a message, itself included, if it has no bytes
};

// How many messages without bytes may stand in a row: nothing else limits their number.
constexpr uint64_t kMostEmpty = 1024;

// A message type and those that its fields are of.
class Program {
 public:
  Program() = default;
  Program(Program&&) = default;

  // Types come after those they refer to, which leaves none that contains itself; the last is the message's own.
  void add(Object type, std::vector<FieldSpec> fields);

  // One `bytes`.
  Object write(PyObject* message) const;
  // A tuple of `bytes`, its length in front; the first long array in between, where it lies.
  Object frame(PyObject* message) const;
  Object read(PyObject* data) const;
  // As `receive`, but with the message that the frame holds; a frame that holds none is not told apart.
  Object receive(PyObject* recv_into, PyObject* room) const;

 private:
  std::vector<std::unique_ptr<Layout>> layouts_;
};

// Calls `recv_into(room)`. A pair: the content of a frame, if what came is one alone, as nearly always, else None; and
// how much came.
Object receive(PyObject* recv_into, PyObject* room);

}  // namespace trundle::wire
