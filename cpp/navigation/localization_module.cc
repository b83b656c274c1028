// The Python module `_localization`: amcl's particle filter.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>

#include <array>
#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "particle_filter.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle::navigation {

namespace {

using Release = nb::call_guard<nb::gil_scoped_release>;
using Cells = nb::ndarray<const std::int8_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Numbers = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Floats = nb::ndarray<nb::numpy, float, nb::ndim<2>>;
using Doubles = nb::ndarray<nb::numpy, double, nb::ndim<2>>;
using Tuple = std::tuple<double, double, double>;

constexpr std::size_t kMaxCells = 400'000'000;  // within 32-bit indices

PlanarPose pose_of(const Tuple& pose) { return {std::get<0>(pose), std::get<1>(pose), std::get<2>(pose)}; }
Tuple tuple_of(const PlanarPose& pose) { return {pose.x, pose.y, pose.yaw}; }

template <typename Array, typename Number>
Array array_of(std::vector<Number> numbers, std::size_t rows, std::size_t columns) {
  auto owned = std::make_unique<std::vector<Number>>(std::move(numbers));
  Number* data = owned->data();
  nb::capsule owner(owned.release(), [](void* pointer) noexcept { delete static_cast<std::vector<Number>*>(pointer); });
  return Array(data, {rows, columns}, owner);
}

void make_map(OccupancyMap* self, const Cells& cells, double resolution, double x, double y) {
  if (cells.size() > kMaxCells) throw nb::value_error("a map has at most 400 million cells");
  if (!(resolution > 0.0)) throw nb::value_error("a map's resolution is positive");
  new (self) OccupancyMap{static_cast<int>(cells.shape(1)),
                          static_cast<int>(cells.shape(0)),
                          resolution,
                          x,
                          y,
                          std::vector<std::int8_t>(cells.data(), cells.data() + cells.size())};
}

Floats distances(const OccupancyMap& map, double limit) {
  std::vector<float> result;
  {
    const nb::gil_scoped_release release;
    result = distances_to_occupied(map, limit);
  }
  return array_of<Floats>(std::move(result), static_cast<std::size_t>(map.height), static_cast<std::size_t>(map.width));
}

LaserScan scan_of(const Numbers& ranges, const Numbers& bearings, double range_max, double x, double y) {
  if (ranges.size() != bearings.size()) throw nb::value_error("each range has a bearing");
  if (!(range_max > 0.0)) throw nb::value_error("the maximum range is positive");
  return {x, y, range_max, std::vector<double>(ranges.data(), ranges.data() + ranges.size()),
          std::vector<double>(bearings.data(), bearings.data() + bearings.size())};
}

void weigh(ParticleFilter& filter, LaserModel& model, const Numbers& ranges, const Numbers& bearings, double range_max,
           double x, double y) {
  const LaserScan scan = scan_of(ranges, bearings, range_max, x, y);
  const nb::gil_scoped_release release;
  filter.weigh(model, scan);
}

Tuple align(const LaserModel& model, const Tuple& prior, const Numbers& ranges, const Numbers& bearings,
            double range_max, double x, double y) {
  const LaserScan scan = scan_of(ranges, bearings, range_max, x, y);
  const nb::gil_scoped_release release;
  return tuple_of(model.align(pose_of(prior), scan));
}

Doubles particles_of(const ParticleFilter& filter) {
  std::vector<double> rows;
  for (const auto& [pose, weight] : filter.particles()) rows.insert(rows.end(), {pose.x, pose.y, pose.yaw, weight});
  return array_of<Doubles>(std::move(rows), filter.particles().size(), 4);
}

std::tuple<Tuple, std::array<double, 9>> estimate(const ParticleFilter& filter) {
  const Estimate result = filter.estimate();
  return {tuple_of(result.pose), result.covariance};
}

FilterOptions filter_options(int min_particles, int max_particles, double kld_err, double kld_z, double alpha_slow,
                             double alpha_fast, bool selective_resampling) {
  if (max_particles < 1 || !(kld_err > 0.0)) throw nb::value_error("max_particles and kld_err are positive");
  return {min_particles, max_particles, kld_err, kld_z, alpha_slow, alpha_fast, selective_resampling};
}

void bind_laser(nb::module_& module) {
  nb::class_<LaserOptions>(module, "LaserOptions")
      .def(nb::init<>())
      .def_rw("max_beams", &LaserOptions::max_beams)
      .def_rw("z_hit", &LaserOptions::z_hit)
      .def_rw("z_short", &LaserOptions::z_short)
      .def_rw("z_max", &LaserOptions::z_max)
      .def_rw("z_rand", &LaserOptions::z_rand)
      .def_rw("sigma_hit", &LaserOptions::sigma_hit)
      .def_rw("lambda_short", &LaserOptions::lambda_short)
      .def_rw("max_distance", &LaserOptions::max_distance)
      .def_rw("do_beamskip", &LaserOptions::do_beamskip)
      .def_rw("beam_skip_distance", &LaserOptions::beam_skip_distance)
      .def_rw("beam_skip_threshold", &LaserOptions::beam_skip_threshold)
      .def_rw("beam_skip_error_threshold", &LaserOptions::beam_skip_error_threshold)
      .def_prop_rw(
          "kind", [](const LaserOptions& options) { return static_cast<int>(options.kind); },
          [](LaserOptions& options, int kind) { options.kind = static_cast<LaserKind>(kind); });
  nb::class_<LaserModel>(module, "LaserModel")
      .def(nb::init<const LaserOptions&, std::shared_ptr<OccupancyMap>>(), "options"_a, "map"_a, Release())
      .def("align", &align, "prior"_a, "ranges"_a, "bearings"_a, nb::kw_only(), "range_max"_a, "x"_a, "y"_a);
}

}  // namespace

NB_MODULE(_localization, module) {
  nb::class_<OccupancyMap>(module, "OccupancyMap")
      .def("__init__", &make_map, "cells"_a, nb::kw_only(), "resolution"_a, "x"_a, "y"_a)
      .def("distances", &distances, "limit"_a)
      .def(
          "cast_ray",
          [](const OccupancyMap& map, double x, double y, double angle, double limit) {
            return cast_ray(map, x, y, angle, limit);
          },
          "x"_a, "y"_a, "angle"_a, "limit"_a);
  bind_laser(module);
  nb::class_<OdometryModel>(module, "OdometryModel")
      .def(
          "__init__",
          [](OdometryModel* self, int kind, const std::array<double, 5>& alphas) {
            new (self) OdometryModel{static_cast<OdometryKind>(kind), alphas};
          },
          "kind"_a, "alphas"_a);
  nb::class_<FilterOptions>(module, "FilterOptions")
      .def(
          "__init__",
          [](FilterOptions* self, int min_particles, int max_particles, double kld_err, double kld_z, double alpha_slow,
             double alpha_fast, bool selective_resampling) {
            new (self) FilterOptions(filter_options(min_particles, max_particles, kld_err, kld_z, alpha_slow,
                                                    alpha_fast, selective_resampling));
          },
          nb::kw_only(), "min_particles"_a, "max_particles"_a, "kld_err"_a, "kld_z"_a, "alpha_slow"_a, "alpha_fast"_a,
          "selective_resampling"_a = false);
  nb::class_<ParticleFilter>(module, "ParticleFilter")
      .def(nb::init<const FilterOptions&, std::shared_ptr<OccupancyMap>, std::uint64_t>(), "options"_a, "map"_a,
           nb::kw_only(), "seed"_a, Release())
      .def("set_options", &ParticleFilter::set_options, "options"_a)
      .def(
          "spread",
          [](ParticleFilter& filter, const Tuple& mean, const std::array<double, 9>& covariance) {
            filter.spread(pose_of(mean), covariance);
          },
          "mean"_a, "covariance"_a, Release())
      .def("spread_over_map", &ParticleFilter::spread_over_map, Release())
      .def(
          "move",
          [](ParticleFilter& filter, const OdometryModel& model, const Tuple& from, const Tuple& to) {
            filter.move(model, pose_of(from), pose_of(to));
          },
          "model"_a, "start"_a, "end"_a, Release())
      .def("weigh", &weigh, "model"_a, "ranges"_a, "bearings"_a, nb::kw_only(), "range_max"_a, "x"_a, "y"_a)
      .def("resample", &ParticleFilter::resample, Release())
      .def("estimate", &estimate, Release())
      .def("particles", &particles_of);
}

}  // namespace trundle::navigation
