// The Python module `_mapping`: gmapping's particle filter, hector_mapping's pyramid, the mapper by a pose graph.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/tuple.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "graph_slam_bindings.h"
#include "grid_slam.h"
#include "hector_bindings.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle::navigation {

namespace {

using Release = nb::call_guard<nb::gil_scoped_release>;
using Numbers = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Cells = nb::ndarray<nb::numpy, std::int8_t, nb::ndim<2>>;
using Tuple = std::tuple<double, double, double>;

constexpr std::int64_t kMaxCells = 400'000'000;

std::vector<double> numbers_of(const Numbers& numbers) { return {numbers.data(), numbers.data() + numbers.size()}; }

PlanarPose pose_of(const Tuple& pose) {
  const auto [x, y, yaw] = pose;
  if (!std::isfinite(x + y + yaw)) throw nb::value_error("a pose is finite");
  return {x, y, yaw};
}

void make_slam(GridSlam* self, const SlamOptions& options, const Numbers& bearings, const Tuple& pose,
               std::uint64_t seed) {
  if (!(options.delta > 0.0) || options.particles < 1) throw nb::value_error("delta and particles are positive");
  new (self) GridSlam(options, numbers_of(bearings), pose_of(pose), seed);
}

bool process(GridSlam& slam, const Tuple& odometry, double time_s, const Numbers& ranges) {
  const PlanarPose pose = pose_of(odometry);
  const std::vector<double> values = numbers_of(ranges);
  const nb::gil_scoped_release release;
  return slam.process(pose, time_s, values);
}

Cells draw(GridSlam& slam, int first_column, int first_row, int width, int height, double occupied_threshold) {
  if (width < 0 || height < 0 || std::int64_t{width} * height > kMaxCells)
    throw nb::value_error("a map has at most 400 million cells");
  auto cells = std::make_unique<std::vector<std::int8_t>>();
  {
    const nb::gil_scoped_release release;
    *cells = slam.draw({first_column, first_row, width, height, occupied_threshold});
  }
  std::int8_t* data = cells->data();
  nb::capsule owner(cells.release(),
                    [](void* pointer) noexcept { delete static_cast<std::vector<std::int8_t>*>(pointer); });
  return Cells(data, {static_cast<std::size_t>(height), static_cast<std::size_t>(width)}, owner);
}

std::tuple<int, int, int, int> seen(GridSlam& slam) {
  const SeenCells cells = slam.seen();
  return {cells.first_column, cells.first_row, cells.last_column, cells.last_row};
}

}  // namespace

NB_MODULE(_mapping, module) {
  nb::class_<SlamOptions>(module, "SlamOptions")
      .def(nb::init<>())
      .def_prop_rw(
          "sigma", [](const SlamOptions& o) { return o.match.sigma; },
          [](SlamOptions& o, double value) { o.match.sigma = value; })
      .def_prop_rw(
          "kernel_size", [](const SlamOptions& o) { return o.match.kernel_size; },
          [](SlamOptions& o, int value) { o.match.kernel_size = value; })
      .def_prop_rw(
          "linear_step", [](const SlamOptions& o) { return o.match.linear_step; },
          [](SlamOptions& o, double value) { o.match.linear_step = value; })
      .def_prop_rw(
          "angular_step", [](const SlamOptions& o) { return o.match.angular_step; },
          [](SlamOptions& o, double value) { o.match.angular_step = value; })
      .def_prop_rw(
          "iterations", [](const SlamOptions& o) { return o.match.iterations; },
          [](SlamOptions& o, int value) { o.match.iterations = value; })
      .def_prop_rw(
          "likelihood_sigma", [](const SlamOptions& o) { return o.match.likelihood_sigma; },
          [](SlamOptions& o, double value) { o.match.likelihood_sigma = value; })
      .def_prop_rw(
          "skipped_beams", [](const SlamOptions& o) { return o.match.skipped_beams; },
          [](SlamOptions& o, int value) { o.match.skipped_beams = value; })
      .def_rw("delta", &SlamOptions::delta)
      .def_rw("max_range", &SlamOptions::max_range)
      .def_rw("usable_range", &SlamOptions::usable_range)
      .def_rw("minimum_score", &SlamOptions::minimum_score)
      .def_rw("likelihood_gain", &SlamOptions::likelihood_gain)
      .def_rw("srr", &SlamOptions::srr)
      .def_rw("srt", &SlamOptions::srt)
      .def_rw("str", &SlamOptions::str)
      .def_rw("stt", &SlamOptions::stt)
      .def_rw("linear_update", &SlamOptions::linear_update)
      .def_rw("angular_update", &SlamOptions::angular_update)
      .def_rw("temporal_update", &SlamOptions::temporal_update)
      .def_rw("resample_threshold", &SlamOptions::resample_threshold)
      .def_rw("particles", &SlamOptions::particles);
  nb::class_<GridSlam>(module, "GridSlam")
      .def("__init__", &make_slam, "options"_a, "bearings"_a, "pose"_a, nb::kw_only(), "seed"_a)
      .def("process", &process, "odometry"_a, "time_s"_a, "ranges"_a)
      .def("seen", &seen, Release())
      .def("draw", &draw, nb::kw_only(), "first_column"_a, "first_row"_a, "width"_a, "height"_a, "occupied_threshold"_a)
      .def_prop_ro("pose",
                   [](const GridSlam& slam) {
                     const PlanarPose pose = slam.pose();
                     return Tuple{pose.x, pose.y, pose.yaw};
                   })
      .def_prop_ro("entropy", &GridSlam::entropy)
      .def_prop_ro("unmatched_share", &GridSlam::unmatched_share);
  bind_hector(module);
  bind_graph_slam(module);
}

}  // namespace trundle::navigation
