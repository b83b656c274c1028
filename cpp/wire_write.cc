// Messages to bytes.
//
// Attributes and elements may be Python code that changes the message meanwhile: all that is looked at is held.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "wire_layout.h"

namespace trundle::wire {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

// From here on, to copy an array takes longer than to leave it where it is.
constexpr Py_ssize_t kLongBytes = 32 * 1024;

// Bytes that become more: on the stack while they are few, then in the `bytes` that they end as.
class Output {
 public:
  Py_ssize_t size() const { return used_; }

  char* add(size_t count) {
    if (count > static_cast<size_t>(room_ - used_)) grow(count);
    char* const at = begin_ + used_;
    used_ += static_cast<Py_ssize_t>(count);
    return at;
  }

  template <typename Number>
  void put(Number number) {
    std::memcpy(add(sizeof number), &number, sizeof number);
  }

  void put_at(Py_ssize_t place, uint32_t number) { std::memcpy(begin_ + place, &number, sizeof number); }

  Object part(Py_ssize_t from, Py_ssize_t to) const {
    return taken(PyBytes_FromStringAndSize(begin_ + from, to - from));
  }

  Object all() {
    if (!bytes_) return part(0, used_);
    resize(used_);
    return std::move(bytes_);
  }

 private:
  void grow(size_t count) {
    if (count > static_cast<size_t>(PY_SSIZE_T_MAX / 4 - used_)) refuse(PyExc_OverflowError, "it is too long");
    const Py_ssize_t needed = used_ + static_cast<Py_ssize_t>(count);
    const Py_ssize_t room = std::max<Py_ssize_t>(2 * room_, needed + 64);
    if (bytes_) {
      resize(room);
    } else {
      bytes_ = taken(PyBytes_FromStringAndSize(nullptr, room));
      std::memcpy(PyBytes_AS_STRING(bytes_.get()), few_, static_cast<size_t>(used_));
    }
    begin_ = PyBytes_AS_STRING(bytes_.get());
    room_ = room;
  }

  void resize(Py_ssize_t size) {
    PyObject* bytes = bytes_.release();
    if (_PyBytes_Resize(&bytes, size) != 0) throw Raised{};
    bytes_.reset(bytes);
  }

  char few_[1024];
  char* begin_ = few_;
  Py_ssize_t used_ = 0, room_ = sizeof few_;
  Object bytes_;
};

// As struct.pack takes them: what has __index__ is an integer, what has __float__ a real number.
template <typename Number>
Number integer(PyObject* value) {
  const Object index = PyLong_Check(value) ? kept(value) : taken(PyNumber_Index(value));
  if constexpr (std::is_same_v<Number, uint64_t>) {
    const unsigned long long number = PyLong_AsUnsignedLongLong(index.get());
    if (number == std::numeric_limits<unsigned long long>::max() && PyErr_Occurred()) throw Raised{};
    return number;
  } else {
    int overflow = 0;
    const long long number = PyLong_AsLongLongAndOverflow(index.get(), &overflow);
    if (number == -1 && PyErr_Occurred()) throw Raised{};
    if (overflow || number < std::numeric_limits<Number>::min() || number > std::numeric_limits<Number>::max())
      refuse(PyExc_OverflowError, "an integer is out of its field's range");
    return static_cast<Number>(number);
  }
}

double real(PyObject* value) {
  if (PyFloat_CheckExact(value)) return PyFloat_AS_DOUBLE(value);
  const double number = PyFloat_AsDouble(value);
  if (number == -1.0 && PyErr_Occurred()) throw Raised{};
  return number;
}

float short_real(const Field& field, PyObject* value) {
  const double number = real(value);
  const float rounded = static_cast<float>(number);
  if (std::isinf(rounded) && !std::isinf(number))
    refuse(PyExc_OverflowError, "'%U' is more than a float32 holds", field.name.get());
  return rounded;
}

bool truth(PyObject* value) {
  const int is_true = PyObject_IsTrue(value);
  if (is_true < 0) throw Raised{};
  return is_true;
}

class Writer {
 public:
  Output out;

  // `splits`: whether a long array may stay where it is.
  explicit Writer(bool splits) : splits_(splits) {}

  void write(const Layout& layout, PyObject* message) {
    for (const Field& field : layout.fields) {
      if (field.kind == Kind::kNothing) continue;
      const Object value = taken(PyObject_GetAttr(message, field.name.get()));
      if (field.count == kOne)
        write_one(field, value.get());
      else if (is_number(field.kind))
        write_numbers(field, value.get());
      else
        write_list(field, value.get());
    }
  }

  // Those before and behind the long array that stays where it is.
  Object pieces() {
    const Py_ssize_t apart = array_ ? PyMemoryView_GET_BUFFER(array_.get())->len : 0;
    const uint64_t size = static_cast<uint64_t>(out.size()) + static_cast<uint64_t>(apart) - sizeof(uint32_t);
    out.put_at(0, counted(size));
    if (!array_) return taken(PyTuple_Pack(1, out.all().get()));
    const Object bytes = taken(PyObject_CallMethod(array_.get(), "cast", "s", "B"));
    const Object array = taken(PyObject_CallMethod(bytes.get(), "toreadonly", nullptr));
    const Object head = out.part(0, cut_);
    if (cut_ == out.size()) return taken(PyTuple_Pack(2, head.get(), array.get()));
    return taken(PyTuple_Pack(3, head.get(), array.get(), out.part(cut_, out.size()).get()));
  }

 private:
  static uint32_t counted(uint64_t count) {
    if (count > UINT32_MAX) refuse(PyExc_OverflowError, "it is too long");
    return static_cast<uint32_t>(count);
  }

  void put_count(const Field& field, Py_ssize_t count) {
    if (field.count == kAny)
      out.put(counted(static_cast<uint64_t>(count)));
    else if (count != field.count)
      refuse(PyExc_ValueError, "'%U' has another length", field.name.get());
  }

  void write_one(const Field& field, PyObject* value) {
    switch (field.kind) {
      case Kind::kBool: return out.put<uint8_t>(truth(value));
      case Kind::kInt8: return out.put(integer<int8_t>(value));
      case Kind::kUInt8: return out.put(integer<uint8_t>(value));
      case Kind::kInt16: return out.put(integer<int16_t>(value));
      case Kind::kUInt16: return out.put(integer<uint16_t>(value));
      case Kind::kInt32: return out.put(integer<int32_t>(value));
      case Kind::kUInt32: return out.put(integer<uint32_t>(value));
      case Kind::kInt64: return out.put(integer<int64_t>(value));
      case Kind::kUInt64: return out.put(integer<uint64_t>(value));
      case Kind::kFloat32: return out.put(short_real(field, value));
      case Kind::kFloat64: return out.put(real(value));
      case Kind::kString: return write_text(value);
      case Kind::kMessage: return write(*field.message, value);
      case Kind::kNothing: return;
    }
  }

  void write_text(PyObject* text) {
    if (!PyUnicode_Check(text)) refuse(PyExc_TypeError, "a text is a str");
    Py_ssize_t size = 0;
    const char* const utf8 = PyUnicode_AsUTF8AndSize(text, &size);
    if (!utf8) throw Raised{};
    out.put(counted(static_cast<uint64_t>(size)));
    std::memcpy(out.add(static_cast<size_t>(size)), utf8, static_cast<size_t>(size));
  }

  void write_list(const Field& field, PyObject* value) {
    if (PyObject_Size(value) < 0) throw Raised{};  // what gives but one after the other is no list
    const Object items = taken(PySequence_Fast(value, "no list"));
    const Py_ssize_t count = PySequence_Fast_GET_SIZE(items.get());
    put_count(field, count);
    for (Py_ssize_t i = 0; i < count; ++i) {
      if (PySequence_Fast_GET_SIZE(items.get()) != count)
        refuse(PyExc_ValueError, "'%U' changes while it is written", field.name.get());
      write_one(field, kept(PySequence_Fast_GET_ITEM(items.get(), i)).get());
    }
  }

  void write_numbers(const Field& field, PyObject* value) {
    if (PyList_CheckExact(value) || PyTuple_CheckExact(value)) return write_plain(field, value);
    const View view(value, PyBUF_ND | PyBUF_FORMAT);
    const char* const told = view.format ? view.format : "B";
    const bool is_plain = !*told || !std::strchr("@=<^", *told);  // numpy's '=' says that they lie anywhere
    const char* const format = is_plain ? told : told + 1;
    if (view.ndim < 1 || view.itemsize != static_cast<Py_ssize_t>(bytes_of(field.kind)) || !is_of(field.kind, format))
      refuse(PyExc_TypeError, "'%U' is no array of its type", field.name.get());
    put_count(field, view.len / view.itemsize);
    if (splits_ && !array_ && view.len >= kLongBytes && is_plain) {  // no memoryview casts others
      array_ = taken(PyMemoryView_FromObject(value));
      if (PyMemoryView_GET_BUFFER(array_.get())->len != view.len)
        refuse(PyExc_ValueError, "'%U' changes while it is written", field.name.get());
      cut_ = out.size();
    } else if (view.len) {
      std::memcpy(out.add(static_cast<size_t>(view.len)), view.buf, static_cast<size_t>(view.len));
    }
  }

  // A list of plain numbers: to read them runs no Python code that could change it. Others are the caller's to mend.
  void write_plain(const Field& field, PyObject* list) {
    const Py_ssize_t count = PySequence_Fast_GET_SIZE(list);
    put_count(field, count);
    for (Py_ssize_t i = 0; i < count; ++i) {
      PyObject* const item = PySequence_Fast_GET_ITEM(list, i);
      if (!is_plain(field.kind, item)) refuse(PyExc_TypeError, "'%U' is no list of plain numbers", field.name.get());
      write_one(field, item);
    }
  }

  static bool is_plain(Kind kind, PyObject* item) {
    if (kind == Kind::kBool) return PyBool_Check(item);
    if (!is_real(kind)) return PyLong_CheckExact(item);
    return PyFloat_Check(item) || (PyLong_CheckExact(item) && is_exact(item));
  }

  // Whether a double is the same integer: others would be rounded twice on their way to a float32.
  static bool is_exact(PyObject* integer) {
    constexpr long long kMost = 1LL << std::numeric_limits<double>::digits;
    int overflow = 0;
    const long long number = PyLong_AsLongLongAndOverflow(integer, &overflow);
    return !overflow && -kMost <= number && number <= kMost;
  }

  // Whether numbers of the right size are of that kind; those without sign count as those with one.
  static bool is_of(Kind kind, const char* format) {
    return format[0] && !format[1] && std::strchr(is_real(kind) ? "fd" : "?bBhHiIlLqQ", format[0]);
  }

  const bool splits_;
  Object array_;  // a memoryview
  Py_ssize_t cut_ = 0;
};

}  // namespace

Object Program::write(PyObject* message) const {
  Writer writer(false);
  writer.write(*layouts_.back(), message);
  return writer.out.all();
}

Object Program::frame(PyObject* message) const {
  Writer writer(true);
  writer.out.put<uint32_t>(0);  // its length, once that is known
  writer.write(*layouts_.back(), message);
  return writer.pieces();
}

}  // namespace trundle::wire
