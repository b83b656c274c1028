#include "motor_bindings.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/tuple.h>

#include <cstdint>
#include <cstring>
#include <tuple>
#include <vector>

#include "motor_bank.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle {

namespace {

template <typename Value, typename Row>
using Rows = nb::ndarray<Value, nb::shape<-1, static_cast<nb::ssize_t>(sizeof(Row) / sizeof(double))>, nb::c_contig,
                         nb::device::cpu>;
using Command = std::tuple<double, double, double, double>;

void make_bank(MotorBank* self, const nb::object& model, const nb::object& data,
               const Rows<const double, MotorAxis>& axes, const Rows<double, MotorState>& states) {
  std::vector<MotorAxis> rows(axes.shape(0));
  if (!rows.empty()) std::memcpy(rows.data(), axes.data(), rows.size() * sizeof(MotorAxis));
  const auto address = [](const nb::object& of) { return nb::cast<std::uintptr_t>(of.attr("_address")); };
  new (self) MotorBank(reinterpret_cast<mjModel*>(address(model)), reinterpret_cast<mjData*>(address(data)),
                       std::move(rows), {reinterpret_cast<MotorState*>(states.data()), states.shape(0)});
}

Command command_of(const MotorBank& bank, int axis) {
  const MotorCommand command = bank.command_of(axis);
  return {command.target, command.max_effort, command.rate, command.effort};
}

void repeat(MotorBank& bank, int axis, const Command& command) {
  const auto [target, max_effort, rate, effort] = command;
  bank.repeat(axis, {target, max_effort, rate, effort});
}

}  // namespace

void bind_motors(nb::module_& module) {
  nb::class_<MotorBank>(module, "MotorBank")
      .def("__init__", make_bank, "model"_a, "data"_a, "axes"_a, "states"_a.noconvert(), nb::keep_alive<1, 2>(),
           nb::keep_alive<1, 3>(), nb::keep_alive<1, 5>())
      .def("command_effort", &MotorBank::command_effort, "axis"_a, "effort"_a, "hardware"_a)
      .def("command_velocity", &MotorBank::command_velocity, "axis"_a, "velocity"_a, "max_effort"_a, "hardware"_a)
      .def("command_position", &MotorBank::command_position, "axis"_a, "position"_a, "max_effort"_a, "rate"_a)
      .def("drive_kinematically", &MotorBank::drive_kinematically, "axis"_a, "velocity"_a, "hardware"_a)
      .def("repeat", repeat, "axis"_a, "command"_a)
      .def("command_of", command_of, "axis"_a)
      .def_prop_ro("switches", &MotorBank::switches);
  module.def(
      "wake_tree",
      [](std::uintptr_t model, std::uintptr_t data, int dof) {
        wake_tree(reinterpret_cast<const mjModel*>(model), reinterpret_cast<mjData*>(data), dof);
      },
      "model"_a, "data"_a, "dof"_a);
}

}  // namespace trundle
