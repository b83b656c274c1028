// Messages to bytes.
//
// Reading attributes and elements may run Python code that changes the message: references are held throughout.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "message_layout.h"

namespace trundle::messages {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as stored in memory");

// Longer arrays are cheaper to send in place than to copy.
constexpr Py_ssize_t kLongBytes = 32 * 1024;

// Growing buffer: on the stack at first, then in the `bytes` that is returned.
class ByteBuffer {
 public:
  Py_ssize_t size() const { return used_; }

  char* add(size_t count) {
    if (count > static_cast<size_t>(capacity_ - used_)) grow(count);
    char* const at = begin_ + used_;
    used_ += static_cast<Py_ssize_t>(count);
    return at;
  }

  template <typename Number>
  void put(Number number) {
    std::memcpy(add(sizeof number), &number, sizeof number);
  }

  void put_at(Py_ssize_t offset, uint32_t number) { std::memcpy(begin_ + offset, &number, sizeof number); }

  std::string_view view() const { return {begin_, static_cast<size_t>(used_)}; }

  Object slice(Py_ssize_t from, Py_ssize_t to) const {
    return steal(PyBytes_FromStringAndSize(begin_ + from, to - from));
  }

  Object bytes_object() {
    if (!bytes_) return slice(0, used_);
    resize(used_);
    return std::move(bytes_);
  }

 private:
  void grow(size_t count) {
    if (count > static_cast<size_t>(PY_SSIZE_T_MAX / 4 - used_)) raise_error(PyExc_OverflowError, "it is too long");
    const Py_ssize_t needed = used_ + static_cast<Py_ssize_t>(count);
    const Py_ssize_t capacity = std::max<Py_ssize_t>(2 * capacity_, needed + 64);
    if (bytes_) {
      resize(capacity);
    } else {
      bytes_ = steal(PyBytes_FromStringAndSize(nullptr, capacity));
      std::memcpy(PyBytes_AS_STRING(bytes_.get()), inline_, static_cast<size_t>(used_));
    }
    begin_ = PyBytes_AS_STRING(bytes_.get());
    capacity_ = capacity;
  }

  void resize(Py_ssize_t size) {
    PyObject* bytes = bytes_.release();
    if (_PyBytes_Resize(&bytes, size) != 0) throw PythonError{};
    bytes_.reset(bytes);
  }

  char inline_[1024];
  char* begin_ = inline_;
  Py_ssize_t used_ = 0, capacity_ = sizeof inline_;
  Object bytes_;
};

// Conversion as in struct.pack: integers by __index__, real numbers by __float__.
template <typename Number>
Number integer(PyObject* value) {
  const Object index = PyLong_Check(value) ? borrow(value) : steal(PyNumber_Index(value));
  if constexpr (std::is_same_v<Number, uint64_t>) {
    const unsigned long long number = PyLong_AsUnsignedLongLong(index.get());
    if (number == std::numeric_limits<unsigned long long>::max() && PyErr_Occurred()) throw PythonError{};
    return number;
  } else {
    int overflow = 0;
    const long long number = PyLong_AsLongLongAndOverflow(index.get(), &overflow);
    if (number == -1 && PyErr_Occurred()) throw PythonError{};
    if (overflow || number < std::numeric_limits<Number>::min() || number > std::numeric_limits<Number>::max())
      raise_error(PyExc_OverflowError, "an integer is out of its field's range");
    return static_cast<Number>(number);
  }
}

double float64(PyObject* value) {
  if (PyFloat_CheckExact(value)) return PyFloat_AS_DOUBLE(value);
  const double number = PyFloat_AsDouble(value);
  if (number == -1.0 && PyErr_Occurred()) throw PythonError{};
  return number;
}

float float32(const Field& field, PyObject* value) {
  const double number = float64(value);
  const float rounded = static_cast<float>(number);
  if (std::isinf(rounded) && !std::isinf(number))
    raise_error(PyExc_OverflowError, "'%U' is more than a float32 holds", field.name.get());
  return rounded;
}

bool boolean(PyObject* value) {
  if (PyUnicode_Check(value)) raise_error(PyExc_TypeError, "a text is no bool");
  const int is_true = PyObject_IsTrue(value);
  if (is_true < 0) throw PythonError{};
  return is_true;
}

class Writer {
 public:
  ByteBuffer out;

  // detach: leave a long array in place.
  explicit Writer(bool detach) : detach_(detach) {}

  void write(const Layout& layout, PyObject* message) {
    for (const Field& field : layout.fields) {
      if (field.kind == Kind::kPlaceholder) continue;
      const Object value = steal(PyObject_GetAttr(message, field.name.get()));
      if (field.count == kScalar) write_one(field, value.get());
      else if (is_number(field.kind)) write_numbers(field, value.get());
      else write_list(field, value.get());
    }
  }

  // The whole frame; empty if it is long.
  std::string_view short_frame() {
    if (array_ || out.size() >= kLongBytes) return {};
    out.put_at(0, static_cast<uint32_t>(out.size()) - sizeof(uint32_t));
    return out.view();
  }

  // The bytes before the detached array, the array, and the bytes after it.
  Object frame_parts() {
    const Py_ssize_t detached = array_ ? PyMemoryView_GET_BUFFER(array_.get())->len : 0;
    const uint64_t size = static_cast<uint64_t>(out.size()) + static_cast<uint64_t>(detached) - sizeof(uint32_t);
    out.put_at(0, checked_count(size));
    if (!array_) return steal(PyTuple_Pack(1, out.bytes_object().get()));
    const Object bytes = steal(PyObject_CallMethod(array_.get(), "cast", "s", "B"));
    const Object array = steal(PyObject_CallMethod(bytes.get(), "toreadonly", nullptr));
    const Object head = out.slice(0, split_);
    if (split_ == out.size()) return steal(PyTuple_Pack(2, head.get(), array.get()));
    return steal(PyTuple_Pack(3, head.get(), array.get(), out.slice(split_, out.size()).get()));
  }

 private:
  static uint32_t checked_count(uint64_t count) {
    if (count > UINT32_MAX) raise_error(PyExc_OverflowError, "it is too long");
    return static_cast<uint32_t>(count);
  }

  void put_count(const Field& field, Py_ssize_t count) {
    if (field.count == kVariable) out.put(checked_count(static_cast<uint64_t>(count)));
    else if (count != field.count) raise_error(PyExc_ValueError, "'%U' has another length", field.name.get());
  }

  void write_one(const Field& field, PyObject* value) {
    switch (field.kind) {
      case Kind::kBool: return out.put<uint8_t>(boolean(value));
      case Kind::kInt8: return out.put(integer<int8_t>(value));
      case Kind::kUInt8: return out.put(integer<uint8_t>(value));
      case Kind::kInt16: return out.put(integer<int16_t>(value));
      case Kind::kUInt16: return out.put(integer<uint16_t>(value));
      case Kind::kInt32: return out.put(integer<int32_t>(value));
      case Kind::kUInt32: return out.put(integer<uint32_t>(value));
      case Kind::kInt64: return out.put(integer<int64_t>(value));
      case Kind::kUInt64: return out.put(integer<uint64_t>(value));
      case Kind::kFloat32: return out.put(float32(field, value));
      case Kind::kFloat64: return out.put(float64(value));
      case Kind::kString: return write_text(value);
      case Kind::kMessage: return write(*field.message, value);
      case Kind::kPlaceholder: return;
    }
  }

  void write_text(PyObject* text) {
    if (!PyUnicode_Check(text)) raise_error(PyExc_TypeError, "a text is a str");
    Py_ssize_t size = 0;
    const char* const utf8 = PyUnicode_AsUTF8AndSize(text, &size);
    if (!utf8) throw PythonError{};
    out.put(checked_count(static_cast<uint64_t>(size)));
    std::memcpy(out.add(static_cast<size_t>(size)), utf8, static_cast<size_t>(size));
  }

  void write_list(const Field& field, PyObject* value) {
    if (PyObject_Size(value) < 0) throw PythonError{};  // generators are not accepted
    const Object items = steal(PySequence_Fast(value, "no list"));
    const Py_ssize_t count = PySequence_Fast_GET_SIZE(items.get());
    put_count(field, count);
    for (Py_ssize_t i = 0; i < count; ++i) {
      if (PySequence_Fast_GET_SIZE(items.get()) != count)
        raise_error(PyExc_ValueError, "'%U' changes while it is written", field.name.get());
      write_one(field, borrow(PySequence_Fast_GET_ITEM(items.get(), i)).get());
    }
  }

  void write_numbers(const Field& field, PyObject* value) {
    if (PyList_CheckExact(value) || PyTuple_CheckExact(value)) return write_plain(field, value);
    const View view(value, PyBUF_ND | PyBUF_FORMAT);
    const char* const declared = view.format ? view.format : "B";
    const bool is_plain = !*declared || !std::strchr("@=<^", *declared);  // '=' is numpy's mark of unaligned data
    const char* const format = is_plain ? declared : declared + 1;
    if (view.ndim < 1 || view.itemsize != static_cast<Py_ssize_t>(bytes_of(field.kind)) || !is_of(field.kind, format))
      raise_error(PyExc_TypeError, "'%U' is no array of its type", field.name.get());
    put_count(field, view.len / view.itemsize);
    if (detach_ && !array_ && view.len >= kLongBytes && is_plain) {  // memoryview.cast takes plain formats only
      array_ = steal(PyMemoryView_FromObject(value));
      if (PyMemoryView_GET_BUFFER(array_.get())->len != view.len)
        raise_error(PyExc_ValueError, "'%U' changes while it is written", field.name.get());
      split_ = out.size();
    } else if (view.len) {
      std::memcpy(out.add(static_cast<size_t>(view.len)), view.buf, static_cast<size_t>(view.len));
    }
  }

  // Plain numbers only: reading them runs no Python code that could change the list. The caller converts other values.
  void write_plain(const Field& field, PyObject* list) {
    const Py_ssize_t count = PySequence_Fast_GET_SIZE(list);
    put_count(field, count);
    for (Py_ssize_t i = 0; i < count; ++i) {
      PyObject* const item = PySequence_Fast_GET_ITEM(list, i);
      if (!is_plain(field.kind, item))
        raise_error(PyExc_TypeError, "'%U' is no list of plain numbers", field.name.get());
      write_one(field, item);
    }
  }

  static bool is_plain(Kind kind, PyObject* item) {
    if (kind == Kind::kBool) return PyBool_Check(item);
    if (!is_real(kind)) return PyLong_CheckExact(item);
    return PyFloat_Check(item) || (PyLong_CheckExact(item) && is_exact(item));
  }

  // True if the integer is exact as a double; others would be rounded twice on conversion to float32.
  static bool is_exact(PyObject* integer) {
    constexpr long long kMost = 1LL << std::numeric_limits<double>::digits;
    int overflow = 0;
    const long long number = PyLong_AsLongLongAndOverflow(integer, &overflow);
    return !overflow && -kMost <= number && number <= kMost;
  }

  // True if a format of the right size matches the kind; signed and unsigned are interchangeable.
  static bool is_of(Kind kind, const char* format) {
    return format[0] && !format[1] && std::strchr(is_real(kind) ? "fd" : "?bBhHiIlLqQ", format[0]);
  }

  const bool detach_;
  Object array_;  // a memoryview
  Py_ssize_t split_ = 0;
};

}  // namespace

Object MessageCodec::write(PyObject* message) const {
  Writer writer(false);
  writer.write(*layouts_.back(), message);
  return writer.out.bytes_object();
}

void MessageCodec::write_short(PyObject* message, const std::function<void(std::string_view)>& use) const {
  Writer writer(true);
  writer.out.put<uint32_t>(0);  // overwritten with the length
  writer.write(*layouts_.back(), message);
  use(writer.short_frame());
}

Object MessageCodec::frame(PyObject* message) const {
  Writer writer(true);
  writer.out.put<uint32_t>(0);  // overwritten with the length
  writer.write(*layouts_.back(), message);
  return writer.frame_parts();
}

}  // namespace trundle::messages
