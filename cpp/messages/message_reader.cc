// Bytes to messages. The bytes are untrusted: every length is checked against the remaining bytes.
#include <array>
#include <cstring>

#include "message_layout.h"

namespace trundle::messages {

namespace {

constexpr const char* kDtypes[kNumbers] = {"?", "i1", "u1", "<i2", "<u2", "<i4", "<u4", "<i8", "<u8", "<f4", "<f8"};

// numpy's frombuffer and dtypes; imported when the first array is read.
struct Numpy {
  Object frombuffer;
  std::array<Object, kNumbers> dtypes;

  Numpy() {
    const Object numpy = steal(PyImport_ImportModule("numpy"));
    frombuffer = steal(PyObject_GetAttrString(numpy.get(), "frombuffer"));
    for (size_t i = 0; i < kNumbers; ++i) dtypes[i] = steal(PyObject_CallMethod(numpy.get(), "dtype", "s", kDtypes[i]));
  }

  // A static local's lock would deadlock: threads wait for it with the GIL held, which the import needs.
  static const Numpy& get() {
    static const Numpy* instance = nullptr;
    if (!instance) {
      auto created = std::make_unique<const Numpy>();
      if (!instance) instance = created.release();
    }
    return *instance;
  }
};

class Reader {
 public:
  Reader(PyObject* data, Arrays arrays)
      : data_(data), view_(data, PyBUF_SIMPLE), arrays_(arrays), no_arguments_(steal(PyTuple_New(0))) {}

  Object read_all(const Layout& layout) {
    Object message = read(layout);
    if (at_ != view_.len) raise_error(PyExc_ValueError, "it ends after %zd", at_);
    return message;
  }

 private:
  Object read(const Layout& layout) {
    if (layout.min_size == 0 && ++empty_messages_ > kMaxEmpty + static_cast<uint64_t>(view_.len))
      raise_error(PyExc_ValueError, "it holds too many messages without bytes");
    auto* const type = reinterpret_cast<PyTypeObject*>(layout.type.get());
    Object message = steal(type->tp_new(type, no_arguments_.get(), nullptr));
    for (const Field& field : layout.fields) {
      const Object value = field.count == kScalar ? read_one(field) : read_some(field);
      if (PyObject_GenericSetAttr(message.get(), field.name.get(), value.get()) != 0) throw PythonError{};
    }
    return message;
  }

  Object read_some(const Field& field) {
    const uint64_t count = field.count == kVariable ? number<uint32_t>(field) : static_cast<uint64_t>(field.count);
    if (count * field.min_size > left()) truncated(field);
    if (is_number(field.kind)) return arrays_ == Arrays::kPlain ? read_plain(field, count) : read_numbers(field, count);
    if (field.min_size == 0 && field.count == kVariable && count * field.message->empty_messages > kMaxEmpty)
      raise_error(PyExc_ValueError, "'%U' holds too many messages without bytes", field.name.get());
    Object list = steal(PyList_New(static_cast<Py_ssize_t>(count)));
    for (uint64_t i = 0; i < count; ++i)
      PyList_SET_ITEM(list.get(), static_cast<Py_ssize_t>(i), read_one(field).release());
    return list;
  }

  Object read_one(const Field& field) {
    switch (field.kind) {
      case Kind::kBool: return steal(PyBool_FromLong(number<uint8_t>(field)));
      case Kind::kInt8: return steal(PyLong_FromLong(number<int8_t>(field)));
      case Kind::kUInt8: return steal(PyLong_FromLong(number<uint8_t>(field)));
      case Kind::kInt16: return steal(PyLong_FromLong(number<int16_t>(field)));
      case Kind::kUInt16: return steal(PyLong_FromLong(number<uint16_t>(field)));
      case Kind::kInt32: return steal(PyLong_FromLong(number<int32_t>(field)));
      case Kind::kUInt32: return steal(PyLong_FromUnsignedLong(number<uint32_t>(field)));
      case Kind::kInt64: return steal(PyLong_FromLongLong(number<int64_t>(field)));
      case Kind::kUInt64: return steal(PyLong_FromUnsignedLongLong(number<uint64_t>(field)));
      case Kind::kFloat32: return steal(PyFloat_FromDouble(number<float>(field)));
      case Kind::kFloat64: return steal(PyFloat_FromDouble(number<double>(field)));
      case Kind::kString: return read_text(field);
      case Kind::kMessage: return read(*field.message);
      case Kind::kPlaceholder: break;
    }
    return steal(PyLong_FromLong(0));
  }

  Object read_text(const Field& field) {
    const uint32_t size = number<uint32_t>(field);
    const char* const errors = arrays_ == Arrays::kPlain ? "replace" : nullptr;
    return steal(PyUnicode_DecodeUTF8(consume(field, size), static_cast<Py_ssize_t>(size), errors));
  }

  Object read_plain(const Field& field, uint64_t count) {
    const auto size = static_cast<Py_ssize_t>(count);
    if (field.kind == Kind::kUInt8) return steal(PyBytes_FromStringAndSize(consume(field, count), size));
    const bool is_list = field.kind == Kind::kBool;
    Object numbers = steal(is_list ? PyList_New(size) : PyTuple_New(size));
    for (Py_ssize_t i = 0; i < size; ++i)
      if (is_list) PyList_SET_ITEM(numbers.get(), i, read_one(field).release());
      else PyTuple_SET_ITEM(numbers.get(), i, read_one(field).release());
    return numbers;
  }

  // Returns a view of the bytes.
  Object read_numbers(const Field& field, uint64_t count) {
    const Numpy& numpy = Numpy::get();
    const Object length = steal(PyLong_FromUnsignedLongLong(count)), offset = steal(PyLong_FromSsize_t(at_));
    PyObject* const dtype = numpy.dtypes[static_cast<size_t>(field.kind)].get();
    PyObject* const arguments[] = {data_, dtype, length.get(), offset.get()};
    consume(field, count * field.min_size);
    return steal(PyObject_Vectorcall(numpy.frombuffer.get(), arguments, std::size(arguments), nullptr));
  }

  template <typename Number>
  Number number(const Field& field) {
    Number number;
    std::memcpy(&number, consume(field, sizeof number), sizeof number);
    return number;
  }

  const char* consume(const Field& field, uint64_t count) {
    if (count > left()) truncated(field);
    const char* const here = static_cast<const char*>(view_.buf) + at_;
    at_ += static_cast<Py_ssize_t>(count);
    return here;
  }

  uint64_t left() const { return static_cast<uint64_t>(view_.len - at_); }

  [[noreturn]] static void truncated(const Field& field) {
    raise_error(PyExc_ValueError, "they end within '%U'", field.name.get());
  }

  PyObject* const data_;
  const View view_;
  const Arrays arrays_;
  const Object no_arguments_;
  Py_ssize_t at_ = 0;
  uint64_t empty_messages_ = 0;
};

// Whole frames at the start of a stream's buffer, after receiving into it once.
struct ReceivedFrames {
  Object contents, count;
  Py_ssize_t parsed = 0;

  // read: called with a frame's bytes; returns its content, or null to leave the frame in the buffer.
  template <typename Read>
  ReceivedFrames(PyObject* recv_into, const ReceiveBuffer& buffer, Read read)
      : contents(steal(PyList_New(0))), count(steal(PyObject_CallOneArg(recv_into, buffer.room))) {
    const Py_ssize_t received = PyLong_AsSsize_t(count.get());
    if (received < 0 && PyErr_Occurred()) throw PythonError{};
    const View view(buffer.whole, PyBUF_SIMPLE);
    if (received <= 0 || buffer.filled < 0 || received > view.len - buffer.filled) return;
    const Py_ssize_t end = buffer.filled + received;
    uint32_t size = 0;
    constexpr Py_ssize_t kBegin = sizeof size;
    while (end - parsed >= kBegin) {
      const char* const frame = static_cast<const char*>(view.buf) + parsed;
      std::memcpy(&size, frame, sizeof size);
      if (size > buffer.limit || size > end - parsed - kBegin) return;
      const Object content = read(steal(PyBytes_FromStringAndSize(frame + kBegin, size)));
      if (!content) return;
      if (PyList_Append(contents.get(), content.get()) != 0) throw PythonError{};
      parsed += kBegin + size;
    }
  }

  Object tuple() const {
    const Object end = steal(PyLong_FromSsize_t(parsed));
    return steal(PyTuple_Pack(3, contents.get(), end.get(), count.get()));
  }
};

}  // namespace

Object MessageCodec::read(PyObject* data) const { return Reader(data, arrays_).read_all(*layouts_.back()); }

Object MessageCodec::receive(PyObject* recv_into, const ReceiveBuffer& buffer) const {
  const auto read_one = [this](const Object& content) {
    try {
      return read(content.get());
    } catch (const PythonError&) {
      PyErr_Clear();  // raised again by the caller, who reads the frame from the buffer
      return Object();
    }
  };
  return ReceivedFrames(recv_into, buffer, read_one).tuple();
}

Object receive(PyObject* recv_into, const ReceiveBuffer& buffer) {
  return ReceivedFrames(recv_into, buffer, [](Object content) { return content; }).tuple();
}

}  // namespace trundle::messages
