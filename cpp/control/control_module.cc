// The Python module `_compiled_control`: compiled controllers and hardware of ros_control.
#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "compiled_law.h"
#include "compiled_robot.h"
#include "control_kit.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle {

namespace {

using Joints = std::vector<std::tuple<std::string, int, std::shared_ptr<ServoJoint>>>;

std::shared_ptr<CompiledRobot> robot_of_joints(std::uintptr_t library, const Joints& joints) {
  std::vector<NamedJoint> named;
  for (const auto& [name, interface, joint] : joints) named.push_back({name, interface, joint});
  return std::make_shared<CompiledRobot>(control_kit_of(library), std::move(named));
}

std::shared_ptr<CompiledRobot> robot_of_model(std::uintptr_t library, const std::string& model) {
  return std::make_shared<CompiledRobot>(control_kit_of(library), model);
}

template <typename Saved>
nb::object checkpoint(nb::handle_t<Saved> self) {
  return nb::cpp_function([owner = nb::borrow(self), restore = nb::cast<Saved&>(self).checkpoint()] { restore(); });
}

}  // namespace

}  // namespace trundle

NB_MODULE(_compiled_control, module) {
  using namespace trundle;
  nb::module_::import_("trundle.sim.control._servo");  // has the base classes, and the joints
  const auto released = nb::call_guard<nb::gil_scoped_release>();
  module.def("open_library", open_control_library, "file"_a, released);
  module.def("kit_folder", kit_folder_of, "library"_a);
  nb::class_<CompiledRobot, ServoHardware>(module, "CompiledRobot")
      .def_static("of_joints", robot_of_joints, "library"_a, "joints"_a)
      .def_static("of_model", robot_of_model, "library"_a, "model"_a)
      .def_prop_ro("names", &CompiledRobot::names)
      .def("connect", &CompiledRobot::connect, "name"_a, "joint"_a)
      .def("stop", &CompiledRobot::stop, "is_active"_a, released)
      .def("begin_stride", &CompiledRobot::begin_stride)
      .def("checkpoint", checkpoint<CompiledRobot>);
  nb::class_<CompiledLaw, ServoLaw>(module, "CompiledLaw")
      .def(nb::init<std::shared_ptr<CompiledRobot>, const std::string&, const std::string&, const std::string&>(),
           "robot"_a, "class_name"_a, "root"_a, "name"_a, released)
      .def_prop_ro("claims", &CompiledLaw::claims)
      .def("start", &CompiledLaw::start, "time_ns"_a, released)
      .def("stop", &CompiledLaw::stop, "time_ns"_a, released)
      .def("begin_stride", &CompiledLaw::begin_stride)
      .def_prop_ro("failure", &CompiledLaw::failure)
      .def("checkpoint", checkpoint<CompiledLaw>);
}
