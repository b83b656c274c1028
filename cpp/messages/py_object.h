// Owned references to Python objects, released also when an exception is thrown.
#pragma once

#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <memory>

namespace trundle::messages {

struct DecRef {
  void operator()(PyObject* object) const { Py_DECREF(object); }
};
using Object = std::unique_ptr<PyObject, DecRef>;

// Thrown with Python's error indicator set.
struct PythonError {};

// Take over a new reference that a call returned; null means that it raised.
inline Object steal(PyObject* returned) {
  if (!returned) throw PythonError{};
  return Object(returned);
}

// Own a borrowed reference.
inline Object borrow(PyObject* borrowed) { return Object(Py_NewRef(borrowed)); }

template <typename... Arguments>
[[noreturn]] void raise_error(PyObject* error, const char* text, Arguments... arguments) {
  PyErr_Format(error, text, arguments...);
  throw PythonError{};
}

// An object's buffer, locked while this lives.
struct View : Py_buffer {
  View(PyObject* owner, int flags) {
    if (PyObject_GetBuffer(owner, this, flags) != 0) throw PythonError{};
  }
  ~View() { PyBuffer_Release(this); }
  View(const View&) = delete;
  View& operator=(const View&) = delete;
};

}  // namespace trundle::messages
