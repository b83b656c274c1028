// The Python module _wire; the only one of the wire_* files that knows nanobind.
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "time_slice.h"
#include "wire_layout.h"

namespace nb = nanobind;
using namespace trundle::wire;

namespace {

using FieldTuple = std::tuple<nb::str, std::string, int64_t, size_t>;
using LayoutTuple = std::tuple<nb::object, std::vector<FieldTuple>>;

// What a call returns; nothing once it raised, which nanobind takes for that.
template <typename Call>
nb::object answer(Call call) {
  try {
    return nb::steal(call().release());
  } catch (const Raised&) {
    return nb::object();
  }
}

void build(Program& program, const std::vector<LayoutTuple>& layouts) {
  if (layouts.empty()) throw std::invalid_argument("a message has a type");
  try {
    for (const auto& [type, fields] : layouts) {
      std::vector<FieldSpec> specs;
      for (const auto& [name, kind, count, message] : fields) specs.push_back({kept(name.ptr()), kind, count, message});
      program.add(kept(type.ptr()), std::move(specs));
    }
  } catch (const Raised&) {
    nb::raise_python_error();
  }
}

}  // namespace

NB_MODULE(_wire, module) {
  nb::set_leak_warnings(false);  // of types known when a program ends
  module.attr("ONE") = kOne;
  module.attr("ANY") = kAny;
  nb::class_<Program>(module, "Program")
      .def("__init__",
           [](Program* self, const std::vector<LayoutTuple>& layouts) {
             Program program;
             build(program, layouts);
             new (self) Program(std::move(program));
           })
      .def("write", [](const Program& self, nb::handle message) {
        return answer([&] { return self.write(message.ptr()); });
      })
      .def("frame", [](const Program& self, nb::handle message) {
        return answer([&] { return self.frame(message.ptr()); });
      })
      .def("read", [](const Program& self, nb::handle data) {
        return answer([&] { return self.read(data.ptr()); });
      })
      .def("receive", [](const Program& self, nb::handle recv_into, nb::handle room) {
        return answer([&] { return self.receive(recv_into.ptr(), room.ptr()); });
      });
  module.def("receive", [](nb::handle recv_into, nb::handle room) {
    return answer([&] { return receive(recv_into.ptr(), room.ptr()); });
  });
  module.def("request_time_slice", &request_time_slice);
}
