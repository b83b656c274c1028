#include "direct_socket.h"

#include <algorithm>

#ifndef _WIN32
#include <unistd.h>
#endif

namespace trundle::messages {

void DirectSocket::write(std::string_view frame) {
  ++frames_sent;
#ifdef _WIN32  // sockets are not file descriptors
  const ptrdiff_t sent = -1;
#else
  const ptrdiff_t sent = ::write(fd_, frame.data(), frame.size());
#endif
  const size_t sent_size = sent > 0 ? static_cast<size_t>(sent) : 0;  // the queue meets and handles the error
  bytes_sent += sent_size;
  if (sent_size == frame.size()) return;
  rest = frame.substr(sent_size);
  is_open = false;
}

bool DirectSender::is_open() const {
  return is_active && !is_long_ && codec_ && !sockets.empty() &&
         std::all_of(sockets.begin(), sockets.end(), [](const auto& socket) { return socket->is_open; });
}

void DirectSender::set_sequence(PyObject* message, uint32_t number) {
  const Object value = steal(PyLong_FromUnsignedLong(number));
  const Object header = steal(PyObject_GetAttrString(message, "header"));
  if (PyObject_SetAttrString(header.get(), "seq", value.get()) != 0) throw PythonError{};
}

DirectSender::Sent DirectSender::send(PyObject* arguments, PyObject* keywords) {
  if (!is_open() || PyTuple_GET_SIZE(arguments) != 1 || PyDict_GET_SIZE(keywords) != 0) return Sent::kNothing;
  PyObject* const message = PyTuple_GET_ITEM(arguments, 0);
  if (Py_TYPE(message) != reinterpret_cast<PyTypeObject*>(type_.get())) return Sent::kNothing;
  const uint32_t number = sequence + 1;
  Sent sent = Sent::kNothing;
  try {
    if (has_header_) set_sequence(message, number);
    codec_->write_short(message, [&](std::string_view frame) {
      // Fields may have run Python code, and with it other threads.
      is_long_ = frame.empty();
      if (!is_open() || sequence + 1 != number) return;
      sequence = number;
      for (const auto& socket : sockets) socket->write(frame);
      sent = is_open() ? Sent::kWhole : Sent::kInPart;
    });
  } catch (const PythonError&) {
    PyErr_Clear();  // the caller serializes the message again, and raises the error
  }
  return sent;
}

}  // namespace trundle::messages
