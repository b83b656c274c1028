// The Python module `_message_codec`; the only file of it that includes nanobind.
#include <nanobind/nanobind.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "direct_socket.h"
#include "freed_memory.h"
#include "message_layout.h"
#include "time_slice.h"

namespace nb = nanobind;
using namespace trundle::messages;

namespace {

using FieldTuple = std::tuple<nb::str, std::string, int64_t, size_t>;
using LayoutTuple = std::tuple<nb::object, std::vector<FieldTuple>>;

// A call's result; null with the error indicator set, which nanobind raises.
template <typename Call>
nb::object returned(Call call) {
  try {
    return nb::steal(call().release());
  } catch (const PythonError&) {
    return nb::object();
  }
}

void add_layouts(MessageCodec& program, const std::vector<LayoutTuple>& layouts) {
  if (layouts.empty()) throw std::invalid_argument("a message has a type");
  try {
    for (const auto& [type, fields] : layouts) {
      std::vector<FieldSpec> specs;
      for (const auto& [name, kind, count, message] : fields)
        specs.push_back({borrow(name.ptr()), kind, count, message});
      program.add(borrow(type.ptr()), std::move(specs));
    }
  } catch (const PythonError&) {
    nb::raise_python_error();
  }
}

void bind_direct_sockets(nb::module_& module) {
  nb::class_<DirectSocket>(module, "DirectSocket")
      .def(nb::init<int>())
      .def_rw("is_open", &DirectSocket::is_open)
      .def_ro("bytes_sent", &DirectSocket::bytes_sent)
      .def_ro("frames_sent", &DirectSocket::frames_sent)
      .def("write",
           [](DirectSocket& self, nb::bytes frame) {
             const bool is_open = self.is_open;
             if (is_open) self.write({frame.c_str(), frame.size()});
             return is_open;
           })
      .def("take_rest", [](DirectSocket& self) {
        const nb::bytes rest(self.rest.data(), self.rest.size());
        self.rest.clear();
        return rest;
      });
  module.attr("NOT_SENT") = static_cast<int>(DirectSender::Sent::kNothing);
  module.attr("SENT") = static_cast<int>(DirectSender::Sent::kWhole);
  module.attr("SENT_IN_PART") = static_cast<int>(DirectSender::Sent::kInPart);
  nb::class_<DirectSender>(module, "DirectSender")
      .def(
          "__init__",
          [](DirectSender* self, nb::handle type, std::shared_ptr<MessageCodec> codec, bool has_header) {
            new (self) DirectSender(borrow(type.ptr()), std::move(codec), has_header);
          },
          nb::arg(), nb::arg().none(), nb::arg())
      .def_rw("is_active", &DirectSender::is_active)
      .def_rw("sequence", &DirectSender::sequence)
      .def_rw("sockets", &DirectSender::sockets)
      .def("send", [](DirectSender& self, nb::tuple arguments, nb::dict keywords) {
        return static_cast<int>(self.send(arguments.ptr(), keywords.ptr()));
      });
}

}  // namespace

NB_MODULE(_message_codec, module) {
  nb::set_leak_warnings(false);  // message types alive at exit are freed with the process
  module.attr("SCALAR") = kScalar;
  module.attr("VARIABLE") = kVariable;
  nb::class_<MessageCodec>(module, "MessageCodec")
      .def(
          "__init__",
          [](MessageCodec* self, const std::vector<LayoutTuple>& layouts, bool plain_arrays) {
            MessageCodec program(plain_arrays ? Arrays::kPlain : Arrays::kNumpy);
            add_layouts(program, layouts);
            new (self) MessageCodec(std::move(program));
          },
          nb::arg(), nb::arg("plain_arrays") = false)
      .def("write", [](const MessageCodec& self,
                       nb::handle message) { return returned([&] { return self.write(message.ptr()); }); })
      .def("frame", [](const MessageCodec& self,
                       nb::handle message) { return returned([&] { return self.frame(message.ptr()); }); })
      .def("read",
           [](const MessageCodec& self, nb::handle data) { return returned([&] { return self.read(data.ptr()); }); })
      .def("receive", [](const MessageCodec& self, nb::handle recv_into, nb::handle room, nb::handle buffer,
                         Py_ssize_t filled, uint32_t limit) {
        return returned([&] { return self.receive(recv_into.ptr(), {room.ptr(), buffer.ptr(), filled, limit}); });
      });
  module.def("receive",
             [](nb::handle recv_into, nb::handle room, nb::handle buffer, Py_ssize_t filled, uint32_t limit) {
               return returned([&] { return receive(recv_into.ptr(), {room.ptr(), buffer.ptr(), filled, limit}); });
             });
  bind_direct_sockets(module);
  module.def("keep_freed_memory", &keep_freed_memory);
  module.def("request_time_slice", &request_time_slice);
}
