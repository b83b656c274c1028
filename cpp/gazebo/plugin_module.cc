// The Python module `_plugin_host`: compiled plugins of Gazebo, which act before each step of the engine.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "plugin_host.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle {

namespace {

using Axis = std::tuple<int, int, int, double, bool>;
using Joint = std::tuple<std::string, std::vector<Axis>, int, std::array<double, 3>, double>;

void make_host(PluginHost* self, const std::array<std::uintptr_t, 5>& kinematics, std::string name, nb::bytes world) {
  const Kinematics functions{reinterpret_cast<decltype(&mj_kinematics)>(kinematics[0]),
                             reinterpret_cast<decltype(&mj_comPos)>(kinematics[1]),
                             reinterpret_cast<decltype(&mj_comVel)>(kinematics[2]),
                             reinterpret_cast<decltype(&mj_contactForce)>(kinematics[3]),
                             reinterpret_cast<decltype(&mj_rnePostConstraint)>(kinematics[4])};
  new (self) PluginHost(functions, std::move(name), std::string(world.c_str(), world.size()));
}

void bind_world(PluginHost& self, std::uintptr_t model, std::uintptr_t data, std::shared_ptr<MotorBank> bank,
                const std::vector<std::pair<std::string, int>>& links, const std::vector<Joint>& joints,
                std::vector<std::string> collisions) {
  std::vector<BoundJoint> bound;
  for (const auto& [name, axes, link, anchor, joint_sign] : joints) {
    bound.push_back({name, {}, link, anchor, joint_sign});
    for (const auto& [index, qpos, dof, sign, is_driven] : axes)
      bound.back().axes.push_back({index, qpos, dof, sign, is_driven});
  }
  self.world().bind(reinterpret_cast<mjModel*>(model), reinterpret_cast<mjData*>(data), std::move(bank), links, bound,
                    std::move(collisions));
}

std::string text_of(const nb::bytes& bytes) { return std::string(bytes.c_str(), bytes.size()); }

std::vector<std::pair<std::vector<std::string>, std::vector<double>>> take_requests(PluginHost& self) {
  std::vector<std::pair<std::vector<std::string>, std::vector<double>>> result;
  for (PluginRequest& request : self.world().take_requests())
    result.emplace_back(std::move(request.words), std::move(request.numbers));
  return result;
}

using Values = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Image = nb::ndarray<const std::uint8_t, nb::shape<-1, -1, 3>, nb::c_contig, nb::device::cpu>;
using Depths = nb::ndarray<const float, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using ContactPoint = std::tuple<std::string, std::string, std::array<double, 10>>;

// Depths, if any, have the image's size. Values are as many as the sensor's kind has.
void take_reading(PluginHost& self, int plugin, std::int64_t time_ns, const Values& values,
                  const std::optional<Image>& image, const std::optional<Depths>& depths,
                  const std::vector<ContactPoint>& points) {
  TrundleGazeboReading reading{
      values.data(), static_cast<std::int64_t>(values.shape(0)), nullptr, nullptr, 0, 0, nullptr, 0};
  if (image) {
    reading.image = image->data();
    reading.height = static_cast<int>(image->shape(0));
    reading.width = static_cast<int>(image->shape(1));
  }
  if (depths) {
    if (!image || depths->shape(0) != image->shape(0) || depths->shape(1) != image->shape(1))
      throw nb::value_error("depths have the image's size");
    reading.depths = depths->data();
  }
  std::vector<TrundleGazeboContact> contacts;
  for (const auto& [collision1, collision2, numbers] : points) {
    TrundleGazeboContact contact{collision1.c_str(), collision2.c_str(), {}, {}, {}, numbers[9]};
    for (std::size_t k = 0; k < 3; ++k) {
      contact.position[k] = numbers[k];
      contact.normal[k] = numbers[3 + k];
      contact.force[k] = numbers[6 + k];
    }
    contacts.push_back(contact);
  }
  reading.contacts = contacts.data();
  reading.contact_count = static_cast<int>(contacts.size());
  const nb::gil_scoped_release release;
  self.take_reading(plugin, time_ns, reading);
}

nb::object checkpoint(nb::handle_t<PluginHost> self) {
  return nb::cpp_function(
      [owner = nb::borrow(self), restore = nb::cast<PluginHost&>(self).checkpoint()] { restore(); });
}

}  // namespace

}  // namespace trundle

NB_MODULE(_plugin_host, module) {
  using trundle::PluginHost;
  nb::module_::import_("trundle.sim.physics._contact_laws");  // has the base class, and the motors
  nb::class_<PluginHost, trundle::StepAction>(module, "PluginHost")
      .def("__init__", trundle::make_host, "functions"_a, "name"_a, "world"_a)
      .def("bind", trundle::bind_world, "model"_a, "data"_a, "bank"_a, "links"_a, "joints"_a, "collisions"_a)
      .def(
          "add_model",
          [](PluginHost& self, const std::string& name, const nb::bytes& elements) {
            const std::string text = trundle::text_of(elements);
            const nb::gil_scoped_release release;
            self.add_model(name, text);
          },
          "name"_a, "elements"_a)
      .def("remove_model", &PluginHost::remove_model, "name"_a, nb::call_guard<nb::gil_scoped_release>())
      .def("open", &PluginHost::open, "file"_a, nb::call_guard<nb::gil_scoped_release>())
      .def_static("start_ros", &PluginHost::start_ros, "library"_a, "master_uri"_a, "node"_a,
                  nb::call_guard<nb::gil_scoped_release>())
      .def(
          "load",
          [](PluginHost& self, std::uintptr_t library, const std::string& parent, const std::string& name,
             const std::string& file, const nb::bytes& elements) {
            const std::string text = trundle::text_of(elements);
            const nb::gil_scoped_release release;
            return self.load(library, parent, name, file, text);
          },
          "library"_a, "parent"_a, "name"_a, "file"_a, "elements"_a)
      .def("reset", &PluginHost::reset, "plugin"_a, nb::call_guard<nb::gil_scoped_release>())
      .def("wants_reading", &PluginHost::wants_reading, "plugin"_a)
      .def("take_reading", trundle::take_reading, "plugin"_a, "time_ns"_a, "values"_a, "image"_a.none(),
           "depths"_a.none(), "contacts"_a)
      .def("close", &PluginHost::close, nb::call_guard<nb::gil_scoped_release>())
      .def("begin_stride", &PluginHost::begin_stride)
      .def("finish_stride", &PluginHost::finish_stride)
      .def("act", &PluginHost::act, "time_ns"_a, "step_ns"_a, nb::call_guard<nb::gil_scoped_release>())
      .def("take_requests", trundle::take_requests)
      .def("take_warnings", [](PluginHost& self) { return self.world().take_warnings(); })
      .def("take_changes", [](PluginHost& self) { return self.world().take_changes(); })
      .def("checkpoint", trundle::checkpoint);
}
