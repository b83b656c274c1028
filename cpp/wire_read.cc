// Bytes to messages. The bytes may be anything: a length counts once so much is there.
#include <array>
#include <cstring>

#include "wire_layout.h"

namespace trundle::wire {

namespace {

constexpr const char* kDtypes[kNumbers] = {"?", "i1", "u1", "<i2", "<u2", "<i4", "<u4", "<i8", "<u8", "<f4", "<f8"};

// What numpy is needed for; imported when the first array is read.
struct Numpy {
  Object frombuffer;
  std::array<Object, kNumbers> dtypes;

  Numpy() {
    const Object numpy = taken(PyImport_ImportModule("numpy"));
    frombuffer = taken(PyObject_GetAttrString(numpy.get(), "frombuffer"));
    for (size_t i = 0; i < kNumbers; ++i)
      dtypes[i] = taken(PyObject_CallMethod(numpy.get(), "dtype", "s", kDtypes[i]));
  }

  // A static local would be waited for by threads that hold the interpreter, which the import needs.
  static const Numpy& get() {
    static const Numpy* known = nullptr;
    if (!known) {
      auto made = std::make_unique<const Numpy>();
      if (!known) known = made.release();
    }
    return *known;
  }
};

class Reader {
 public:
  explicit Reader(PyObject* data) : data_(data), view_(data, PyBUF_SIMPLE), nothing_(taken(PyTuple_New(0))) {}

  Object read_all(const Layout& layout) {
    Object message = read(layout);
    if (at_ != view_.len) refuse(PyExc_ValueError, "it ends after %zd", at_);
    return message;
  }

 private:
  Object read(const Layout& layout) {
    auto* const type = reinterpret_cast<PyTypeObject*>(layout.type.get());
    Object message = taken(type->tp_new(type, nothing_.get(), nullptr));
    for (const Field& field : layout.fields) {
      const Object value = field.count == kOne ? read_one(field) : read_some(field);
      if (PyObject_GenericSetAttr(message.get(), field.name.get(), value.get()) != 0) throw Raised{};
    }
    return message;
  }

  Object read_some(const Field& field) {
    const uint64_t count = field.count == kAny ? number<uint32_t>(field) : static_cast<uint64_t>(field.count);
    if (count * field.least > left()) end_within(field);
    if (is_number(field.kind)) return read_numbers(field, count);
    if (field.least == 0 && field.count == kAny && count * field.message->messages > kMostEmpty)
      refuse(PyExc_ValueError, "'%U' holds too many messages without bytes", field.name.get());
    Object list = taken(PyList_New(static_cast<Py_ssize_t>(count)));
    for (uint64_t i = 0; i < count; ++i)
      PyList_SET_ITEM(list.get(), static_cast<Py_ssize_t>(i), read_one(field).release());
    return list;
  }

  Object read_one(const Field& field) {
    switch (field.kind) {
      case Kind::kBool: return taken(PyBool_FromLong(number<uint8_t>(field)));
      case Kind::kInt8: return taken(PyLong_FromLong(number<int8_t>(field)));
      case Kind::kUInt8: return taken(PyLong_FromLong(number<uint8_t>(field)));
      case Kind::kInt16: return taken(PyLong_FromLong(number<int16_t>(field)));
      case Kind::kUInt16: return taken(PyLong_FromLong(number<uint16_t>(field)));
      case Kind::kInt32: return taken(PyLong_FromLong(number<int32_t>(field)));
      case Kind::kUInt32: return taken(PyLong_FromUnsignedLong(number<uint32_t>(field)));
      case Kind::kInt64: return taken(PyLong_FromLongLong(number<int64_t>(field)));
      case Kind::kUInt64: return taken(PyLong_FromUnsignedLongLong(number<uint64_t>(field)));
      case Kind::kFloat32: return taken(PyFloat_FromDouble(number<float>(field)));
      case Kind::kFloat64: return taken(PyFloat_FromDouble(number<double>(field)));
      case Kind::kString: return read_text(field);
      case Kind::kMessage: return read(*field.message);
      case Kind::kNothing: break;
    }
    return taken(PyLong_FromLong(0));
  }

  Object read_text(const Field& field) {
    const uint32_t size = number<uint32_t>(field);
    return taken(PyUnicode_DecodeUTF8(take(field, size), static_cast<Py_ssize_t>(size), nullptr));
  }

  // A view of the bytes.
  Object read_numbers(const Field& field, uint64_t count) {
    const Numpy& numpy = Numpy::get();
    const Object length = taken(PyLong_FromUnsignedLongLong(count)), offset = taken(PyLong_FromSsize_t(at_));
    PyObject* const dtype = numpy.dtypes[static_cast<size_t>(field.kind)].get();
    PyObject* const arguments[] = {data_, dtype, length.get(), offset.get()};
    take(field, count * field.least);
    return taken(PyObject_Vectorcall(numpy.frombuffer.get(), arguments, std::size(arguments), nullptr));
  }

  template <typename Number>
  Number number(const Field& field) {
    Number number;
    std::memcpy(&number, take(field, sizeof number), sizeof number);
    return number;
  }

  const char* take(const Field& field, uint64_t count) {
    if (count > left()) end_within(field);
    const char* const here = static_cast<const char*>(view_.buf) + at_;
    at_ += static_cast<Py_ssize_t>(count);
    return here;
  }

  uint64_t left() const { return static_cast<uint64_t>(view_.len - at_); }

  [[noreturn]] static void end_within(const Field& field) {
    refuse(PyExc_ValueError, "they end within '%U'", field.name.get());
  }

  PyObject* const data_;
  const View view_;
  const Object nothing_;
  Py_ssize_t at_ = 0;
};

struct Received {
  Object content, count;

  Received(PyObject* recv_into, PyObject* room) : count(taken(PyObject_CallOneArg(recv_into, room))) {
    const Py_ssize_t come = PyLong_AsSsize_t(count.get());
    if (come < 0 && PyErr_Occurred()) throw Raised{};
    const View view(room, PyBUF_SIMPLE);
    uint32_t size = 0;
    constexpr Py_ssize_t kBegin = sizeof size;
    if (come < kBegin || come > view.len) return;
    std::memcpy(&size, view.buf, sizeof size);
    if (size == come - kBegin)
      content = taken(PyBytes_FromStringAndSize(static_cast<const char*>(view.buf) + kBegin, come - kBegin));
  }

  Object with(const Object& first) const {
    return taken(PyTuple_Pack(2, first ? first.get() : Py_None, count.get()));
  }
};

}  // namespace

Object Program::read(PyObject* data) const { return Reader(data).read_all(*layouts_.back()); }

Object Program::receive(PyObject* recv_into, PyObject* room) const {
  const Received received(recv_into, room);
  Object message;
  if (received.content) {
    try {
      message = read(received.content.get());
    } catch (const Raised&) {
      PyErr_Clear();  // whoever cuts the frame out of the room meets it again
    }
  }
  return received.with(message);
}

Object receive(PyObject* recv_into, PyObject* room) {
  const Received received(recv_into, room);
  return received.with(received.content);
}

}  // namespace trundle::wire
