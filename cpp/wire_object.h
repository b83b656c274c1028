// Python objects in C++: each is let go of when done with, whatever is thrown meanwhile.
#pragma once

#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <memory>

namespace trundle::wire {

struct LetGo {
  void operator()(PyObject* object) const { Py_DECREF(object); }
};
using Object = std::unique_ptr<PyObject, LetGo>;

// Thrown once the interpreter knows what went wrong.
struct Raised {};

// What a call returned; null says that it raised.
inline Object taken(PyObject* returned) {
  if (!returned) throw Raised{};
  return Object(returned);
}

inline Object kept(PyObject* borrowed) { return Object(Py_NewRef(borrowed)); }

template <typename... Arguments>
[[noreturn]] void refuse(PyObject* error, const char* text, Arguments... arguments) {
  PyErr_Format(error, text, arguments...);
  throw Raised{};
}

// The memory of an object, which cannot be moved meanwhile.
struct View : Py_buffer {
  View(PyObject* whose, int flags) {
    if (PyObject_GetBuffer(whose, this, flags) != 0) throw Raised{};
  }
  ~View() { PyBuffer_Release(this); }
  View(const View&) = delete;
  View& operator=(const View&) = delete;
};

}  // namespace trundle::wire
