// The Python module `_grids`: loops over the cells of costmaps. None holds the GIL.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "costmap_cells.h"
#include "frontiers.h"
#include "inflation.h"
#include "rollout.h"
#include "voxel_rays.h"
#include "wave_front.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle {

namespace {

template <typename Number>
using Grid = nb::ndarray<Number, nb::numpy, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Points = nb::ndarray<const double, nb::numpy, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
using Triples = nb::ndarray<const double, nb::numpy, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using NoGil = nb::gil_scoped_release;

constexpr std::size_t kMaxSide = 1U << 20;

template <typename Number>
GridShape shape_of(const Grid<Number>& grid) {
  if (grid.shape(0) > kMaxSide || grid.shape(1) > kMaxSide) throw nb::value_error("the grid is too large");
  return {static_cast<int>(grid.shape(1)), static_cast<int>(grid.shape(0))};
}

template <typename Number>
nb::object array_of(std::vector<Number> numbers, std::vector<std::size_t> shape) {
  auto* kept = new std::vector<Number>(std::move(numbers));
  const nb::capsule owner(kept, [](void* data) noexcept { delete static_cast<std::vector<Number>*>(data); });
  return nb::cast(nb::ndarray<nb::numpy, Number>(kept->data(), shape.size(), shape.data(), owner));
}

std::vector<std::array<double, 2>> points_of(const Points& points) {
  std::vector<std::array<double, 2>> copies(points.shape(0));
  for (std::size_t i = 0; i < copies.size(); ++i) copies[i] = {points(i, 0), points(i, 1)};
  return copies;
}

void inflate_window(const Grid<std::uint8_t>& grid, const std::array<int, 4>& window,
                    const std::vector<std::uint8_t>& costs, bool inflate_unknown) {
  const GridShape shape = shape_of(grid);
  const auto [x0, y0, x1, y1] = window;
  if (x0 < 0 || y0 < 0 || x1 > shape.width || y1 > shape.height) throw nb::value_error("the window leaves the grid");
  const NoGil unlocked;
  inflate(grid.data(), shape, {x0, y0, x1, y1}, costs, inflate_unknown);
}

void clear_rays(const Grid<std::uint8_t>& grid, std::array<double, 2> sensor, const Points& ends, double range) {
  const GridShape shape = shape_of(grid);
  const int x = static_cast<int>(std::floor(std::clamp(sensor[0], -1.0, 1e9)));
  const int y = static_cast<int>(std::floor(std::clamp(sensor[1], -1.0, 1e9)));
  if (!shape.contains(x, y)) throw nb::value_error("the sensor is outside the grid");
  std::uint8_t* cells = grid.data();
  const NoGil unlocked;
  for (std::size_t i = 0; i < ends.shape(0); ++i) {
    const double dx = ends(i, 0) - sensor[0];
    const double dy = ends(i, 1) - sensor[1];
    const double length = std::hypot(dx, dy);
    if (!std::isfinite(length)) continue;
    const double share = std::min({1.0, range / std::max(length, 1e-9), 1e6 / std::max(length, 1e-9)});
    const int end_x = static_cast<int>(std::floor(sensor[0] + share * dx));
    const int end_y = static_cast<int>(std::floor(sensor[1] + share * dy));
    visit_line(x, y, end_x, end_y, shape.width + shape.height, [&](int column, int row) {
      if (!shape.contains(column, row)) return false;
      cells[shape.index(column, row)] = kFreeSpace;
      return true;
    });
  }
}

void clear_voxel_rays(const Grid<std::uint32_t>& columns, const Grid<std::uint8_t>& costs,
                      const std::array<double, 3>& sensor, const Triples& ends, int levels, int unknown_threshold,
                      int mark_threshold) {
  const GridShape shape = shape_of(columns);
  if (costs.shape(0) != columns.shape(0) || costs.shape(1) != columns.shape(1))
    throw nb::value_error("the grids have one shape");
  if (levels < 0 || levels > kMaxVoxelLevels) throw nb::value_error("a column has at most 16 levels");
  const VoxelColumns voxels{shape, levels, columns.data(), costs.data(), unknown_threshold, mark_threshold};
  const NoGil unlocked;
  for (std::size_t i = 0; i < ends.shape(0); ++i) {
    const std::array<double, 3> end{ends(i, 0), ends(i, 1), ends(i, 2)};
    const auto is_near = [](double value) { return std::fabs(value) < kMaxSide; };
    if (std::all_of(end.begin(), end.end(), is_near) && std::all_of(sensor.begin(), sensor.end(), is_near))
      clear_voxel_ray(voxels, sensor, end);
  }
}

nb::object wave_front(const Grid<const float>& costs, const std::vector<std::array<int, 2>>& seeds,
                      std::array<int, 2> stop) {
  const GridShape shape = shape_of(costs);
  std::vector<float> potential;
  {
    const NoGil unlocked;
    potential = WaveFront(costs.data(), shape, seeds, stop).take();
  }
  return array_of(std::move(potential), {costs.shape(0), costs.shape(1)});
}

nb::object frontiers_of(const Grid<const std::uint8_t>& costs, std::array<int, 2> start) {
  const GridShape shape = shape_of(costs);
  std::vector<std::int32_t> numbers;
  {
    const NoGil unlocked;
    for (const FrontierCell& cell : find_frontiers(costs.data(), shape, start[0], start[1]))
      numbers.insert(numbers.end(), {cell.frontier, cell.column, cell.row});
  }
  const std::size_t count = numbers.size() / 3;
  return array_of(std::move(numbers), {count, 3});
}

nb::object descend_potential(const Grid<const float>& potential, std::array<int, 2> from, std::array<int, 2> to) {
  const GridShape shape = shape_of(potential);
  std::vector<double> numbers;
  {
    const NoGil unlocked;
    for (const auto& [x, y] : descend(potential.data(), shape, from, to)) {
      numbers.push_back(x);
      numbers.push_back(y);
    }
  }
  const std::size_t count = numbers.size() / 2;
  return array_of(std::move(numbers), {count, 2});
}

RolloutSettings settings_of(double sim_time, double granularity, double angular_granularity, double forward_point,
                            const Triple& acceleration, bool accelerates, bool sums_costs) {
  if (!(sim_time > 0 && granularity > 0 && angular_granularity > 0))
    throw nb::value_error("time and granularities are positive");
  return {sim_time, granularity, angular_granularity, forward_point, acceleration, accelerates, sums_costs};
}

void make_maps(RolloutMaps* self, const Grid<const std::uint8_t>& costs, const Grid<const float>& path,
               const Grid<const float>& goal, const Grid<const float>& front, std::array<double, 2> origin,
               double resolution) {
  const GridShape shape = shape_of(costs);
  for (const auto* field : {&path, &goal, &front})
    if (field->shape(0) != costs.shape(0) || field->shape(1) != costs.shape(1))
      throw nb::value_error("the grids have one shape");
  new (self) RolloutMaps{shape, origin, resolution, costs.data(), path.data(), goal.data(), front.data()};
}

nb::object score_rollouts(const RolloutSettings& settings, const RolloutMaps& maps, const Points& footprint,
                          const Triple& pose, const Triple& velocity, const Triples& targets) {
  std::vector<double> numbers;
  {
    const NoGil unlocked;
    FootprintCosts costs(maps, points_of(footprint));
    numbers.reserve(6 * targets.shape(0));
    for (std::size_t i = 0; i < targets.shape(0); ++i) {
      const auto poses = roll_out(settings, pose, velocity, {targets(i, 0), targets(i, 1), targets(i, 2)});
      const auto score = score_rollout(settings, costs, poses);
      numbers.insert(numbers.end(),
                     {score.obstacles, score.path, score.goal, score.front, score.alignment, score.steps});
    }
  }
  return array_of(std::move(numbers), {targets.shape(0), 6});
}

}  // namespace

}  // namespace trundle

NB_MODULE(_grids, module) {
  using namespace trundle;
  module.attr("UNREACHED") = kUnreached;
  module.def("inflate", inflate_window, "cells"_a, "window"_a, "costs"_a, nb::kw_only(), "inflate_unknown"_a);
  module.def("clear_rays", clear_rays, "cells"_a, "sensor"_a, "ends"_a, nb::kw_only(), "range"_a);
  module.def("clear_voxel_rays", clear_voxel_rays, nb::arg("voxels").noconvert(), nb::arg("cells").noconvert(),
             "sensor"_a, "ends"_a, nb::kw_only(), "levels"_a, "unknown_threshold"_a, "mark_threshold"_a);
  module.def("wave_front", wave_front, "costs"_a, "seeds"_a, nb::kw_only(), "stop"_a = std::array<int, 2>{-1, -1});
  module.def("find_frontiers", frontiers_of, "costs"_a, "start"_a);
  module.def("descend", descend_potential, "potential"_a, "start"_a, "end"_a);
  nb::class_<RolloutSettings>(module, "RolloutSettings")
      .def(
          "__init__",
          [](RolloutSettings* self, double sim_time, double granularity, double angular_granularity,
             double forward_point, const Triple& acceleration, bool accelerates, bool sums_costs) {
            new (self) RolloutSettings(settings_of(sim_time, granularity, angular_granularity, forward_point,
                                                   acceleration, accelerates, sums_costs));
          },
          nb::kw_only(), "sim_time"_a, "granularity"_a, "angular_granularity"_a, "forward_point"_a = 0.0,
          "acceleration"_a = Triple{}, "accelerates"_a = false, "sums_costs"_a = false);
  nb::class_<RolloutMaps>(module, "RolloutMaps")
      .def("__init__", make_maps, nb::kw_only(), nb::arg("costs").noconvert(), nb::arg("path").noconvert(),
           nb::arg("goal").noconvert(), nb::arg("front").noconvert(), "origin"_a, "resolution"_a,
           nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(), nb::keep_alive<1, 4>(), nb::keep_alive<1, 5>());
  module.def("score_rollouts", score_rollouts, "settings"_a, "maps"_a, "footprint"_a, "pose"_a, "velocity"_a,
             "targets"_a);
  module.def(
      "roll_out",
      [](const RolloutSettings& settings, const Triple& pose, const Triple& velocity, const Triple& target) {
        return roll_out(settings, pose, velocity, target);
      },
      "settings"_a, "pose"_a, "velocity"_a, "target"_a);
  module.def(
      "footprint_cost",
      [](const Grid<const std::uint8_t>& costs, std::array<double, 2> origin, double resolution,
         const Points& footprint, const Triple& pose) {
        const RolloutMaps maps{shape_of(costs), origin, resolution, costs.data(), nullptr, nullptr, nullptr};
        return footprint_cost(maps, points_of(footprint), pose);
      },
      "costs"_a, "origin"_a, "resolution"_a, "footprint"_a, "pose"_a);
}
