#include "hector_bindings.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/tuple.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

#include "hector_slam.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle::navigation {

namespace {

using Points = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
using Cells = nb::ndarray<nb::numpy, std::int8_t, nb::ndim<2>>;
using Triple = std::tuple<double, double, double>;
using Pair = std::tuple<double, double>;

constexpr int kMaxSize = 20'000;  // 400 million cells

void make_hector(HectorSlam* self, const HectorOptions& options) {
  const bool is_size_valid = options.size >= 2 && options.size <= kMaxSize && options.levels >= 1;
  if (!is_size_valid || !(options.resolution > 0.0)) throw nb::value_error("size, levels and resolution are positive");
  const auto is_probability = [](double value) { return value > 0.0 && value < 1.0; };
  if (!is_probability(options.update_factor_free) || !is_probability(options.update_factor_occupied))
    throw nb::value_error("the update factors are between 0 and 1");
  new (self) HectorSlam(options);
}

bool update(HectorSlam& slam, const Triple& start, const Pair& sensor, const Points& ends, bool is_known) {
  const auto [x, y, yaw] = start;
  const auto [sensor_x, sensor_y] = sensor;
  if (!std::isfinite(x + y + yaw + sensor_x + sensor_y)) throw nb::value_error("a pose is finite");
  std::vector<Point> points;
  points.reserve(ends.shape(0));
  for (std::size_t i = 0; i < ends.shape(0); ++i) {
    const Point point{ends(i, 0), ends(i, 1)};
    if (std::isfinite(point.x + point.y)) points.push_back(point);
  }
  const nb::gil_scoped_release release;
  return slam.update({x, y, yaw}, {sensor_x, sensor_y}, points, is_known);
}

Cells cells(const HectorSlam& slam) {
  auto drawn = std::make_unique<std::vector<std::int8_t>>();
  {
    const nb::gil_scoped_release release;
    *drawn = slam.cells();
  }
  std::int8_t* data = drawn->data();
  nb::capsule owner(drawn.release(),
                    [](void* pointer) noexcept { delete static_cast<std::vector<std::int8_t>*>(pointer); });
  const auto size = static_cast<std::size_t>(slam.size());
  return Cells(data, {size, size}, owner);
}

}  // namespace

void bind_hector(nb::module_& module) {
  nb::class_<HectorOptions>(module, "HectorOptions")
      .def(nb::init<>())
      .def_rw("resolution", &HectorOptions::resolution)
      .def_rw("size", &HectorOptions::size)
      .def_rw("start_x", &HectorOptions::start_x)
      .def_rw("start_y", &HectorOptions::start_y)
      .def_rw("levels", &HectorOptions::levels)
      .def_rw("update_factor_free", &HectorOptions::update_factor_free)
      .def_rw("update_factor_occupied", &HectorOptions::update_factor_occupied)
      .def_rw("update_distance", &HectorOptions::update_distance)
      .def_rw("update_angle", &HectorOptions::update_angle);
  nb::class_<HectorSlam>(module, "HectorSlam")
      .def("__init__", &make_hector, "options"_a)
      .def("reset", &HectorSlam::reset)
      .def("update", &update, "start"_a, "sensor"_a, "ends"_a, nb::kw_only(), "is_known"_a = false)
      .def("cells", &cells)
      .def_prop_ro("pose",
                   [](const HectorSlam& slam) {
                     const PlanarPose pose = slam.pose();
                     return Triple{pose.x, pose.y, pose.yaw};
                   })
      .def_prop_ro("covariance", &HectorSlam::covariance)
      .def_prop_ro("score", &HectorSlam::score);
}

}  // namespace trundle::navigation
