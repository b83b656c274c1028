// The Python module `_bands`: timed elastic bands and bands of bubbles. The optimizations do not hold the GIL.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "band_obstacles.h"
#include "band_optimizer.h"
#include "bubble_band.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle::navigation {

namespace {

using Costs = nb::ndarray<const std::uint8_t, nb::numpy, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
template <std::size_t Columns>
using Rows =
    nb::ndarray<const double, nb::numpy, nb::shape<-1, static_cast<int>(Columns)>, nb::c_contig, nb::device::cpu>;

constexpr std::size_t kMaxSide = 1U << 20;
constexpr double kFarthest = 1e6;  // [m]

nb::object array_of(std::vector<double> numbers, std::size_t columns) {
  auto* kept = new std::vector<double>(std::move(numbers));
  const nb::capsule owner(kept, [](void* data) noexcept { delete static_cast<std::vector<double>*>(data); });
  const std::array<std::size_t, 2> shape{kept->size() / columns, columns};
  return nb::cast(nb::ndarray<nb::numpy, double>(kept->data(), 2, shape.data(), owner));
}

template <std::size_t Columns>
std::vector<std::array<double, Columns>> rows_of(const Rows<Columns>& array) {
  std::vector<std::array<double, Columns>> rows(array.shape(0));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < Columns; ++k) {
      rows[i][k] = array(i, k);
      if (!(std::abs(rows[i][k]) < kFarthest)) throw nb::value_error("the numbers are finite, and below 1e6");
    }
  return rows;
}

GridShape shape_of(const Costs& costs) {
  if (costs.shape(0) > kMaxSide || costs.shape(1) > kMaxSide) throw nb::value_error("the grid is too large");
  return {static_cast<int>(costs.shape(1)), static_cast<int>(costs.shape(0))};
}

nb::object cells_of(const Costs& costs,
                    std::vector<std::array<double, 2>> (*find)(const std::uint8_t*, const GridShape&)) {
  const GridShape shape = shape_of(costs);
  std::vector<double> numbers;
  {
    const nb::gil_scoped_release unlocked;
    for (const auto& [x, y] : find(costs.data(), shape)) numbers.insert(numbers.end(), {x, y});
  }
  return array_of(std::move(numbers), 2);
}

void make_body(RobotBody* self, const Rows<5>& lines, bool is_closed) {
  std::vector<BodyLine> body;
  for (const auto& [x0, y0, x1, y1, radius] : rows_of<5>(lines)) body.push_back({{x0, y0}, {x1, y1}, radius});
  if (body.empty()) throw nb::value_error("a body has at least one line");
  new (self) RobotBody(std::move(body), is_closed);
}

void set_path(TimedBand& band, const Rows<3>& path, const BandSettings& settings) {
  if (path.shape(0) < 2) throw nb::value_error("a path has at least two poses");
  if (settings.min_samples < 3) throw nb::value_error("min_samples is at least 3");
  band.set(rows_of<3>(path), settings);
}

double optimize(TimedBand& band, const BandSettings& settings, const RobotBody& body, const Rows<2>& obstacles,
                const Rows<2>& via_points, const std::array<double, 3>& velocity, double obstacle_scale) {
  if (band.poses.size() < 3) throw nb::value_error("the band has no path");
  if (settings.min_samples < 3) throw nb::value_error("min_samples is at least 3");
  const std::vector<Point> points = rows_of<2>(obstacles), via = rows_of<2>(via_points);
  const nb::gil_scoped_release unlocked;
  return optimize_band(band, settings, {body, points, via, velocity}, obstacle_scale);
}

nb::object relax(const Rows<2>& path, const Rows<2>& obstacles, const BubbleSettings& settings) {
  if (path.shape(0) < 2) throw nb::value_error("a path has at least two points");
  const std::vector<Point> points = rows_of<2>(path), blocked = rows_of<2>(obstacles);
  std::vector<double> numbers;
  {
    const nb::gil_scoped_release unlocked;
    for (const Bubble& bubble : relax_bubbles(points, blocked, settings))
      numbers.insert(numbers.end(), {bubble.center[0], bubble.center[1], bubble.radius});
  }
  return array_of(std::move(numbers), 3);
}

template <typename Owner>
struct Fields {
  nb::class_<Owner>& owner;

  template <typename Number>
  Fields& operator()(const char* name, Number Owner::* field) {
    owner.def_rw(name, field);
    return *this;
  }
};

void bind_settings(nb::module_& module) {
  nb::class_<BandSettings> band(module, "BandSettings");
  band.def(nb::init<>());
#define FIELD(name) (#name, &BandSettings::name)
  Fields<BandSettings>{band} FIELD(dt_ref) FIELD(dt_hysteresis) FIELD(max_vel_x) FIELD(max_vel_x_backwards)
      FIELD(max_vel_y) FIELD(max_vel_trans) FIELD(max_vel_theta) FIELD(acc_lim_x) FIELD(acc_lim_y) FIELD(acc_lim_theta)
          FIELD(min_turning_radius) FIELD(min_obstacle_dist) FIELD(inflation_dist)
              FIELD(obstacle_association_force_inclusion_factor) FIELD(obstacle_association_cutoff_factor)
                  FIELD(penalty_epsilon) FIELD(weight_adapt_factor) FIELD(obstacle_cost_exponent)
                      FIELD(weight_max_vel_x) FIELD(weight_max_vel_y) FIELD(weight_max_vel_theta)
                          FIELD(weight_acc_lim_x) FIELD(weight_acc_lim_y) FIELD(weight_acc_lim_theta)
                              FIELD(weight_kinematics_nh) FIELD(weight_kinematics_forward_drive)
                                  FIELD(weight_kinematics_turning_radius) FIELD(weight_optimaltime)
                                      FIELD(weight_shortest_path) FIELD(weight_viapoint) FIELD(weight_obstacle)
                                          FIELD(weight_inflation) FIELD(min_samples) FIELD(max_samples)
                                              FIELD(no_inner_iterations) FIELD(no_outer_iterations) FIELD(teb_autosize)
                                                  FIELD(exact_arc_length) FIELD(free_goal_vel);
#undef FIELD
  nb::class_<BubbleSettings> bubbles(module, "BubbleSettings");
  bubbles.def(nb::init<>());
#define FIELD(name) (#name, &BubbleSettings::name)
  Fields<BubbleSettings>{bubbles} FIELD(robot_radius) FIELD(min_relative_overlap) FIELD(tiny_bubble_expansion)
      FIELD(internal_force_gain) FIELD(external_force_gain) FIELD(significant_force_lower_bound)
          FIELD(num_iterations_eband_optimization) FIELD(equilibrium_approx_max_recursion_depth);
#undef FIELD
}

}  // namespace

}  // namespace trundle::navigation

NB_MODULE(_bands, module) {
  using namespace trundle::navigation;
  bind_settings(module);
  nb::class_<RobotBody>(module, "RobotBody")
      .def("__init__", make_body, "lines"_a, nb::kw_only(), "is_closed"_a)
      .def(
          "distance",
          [](const RobotBody& body, const BandPose& pose, const Point& point) {
            return body.distance(pose, point).distance;
          },
          "pose"_a, "point"_a);
  nb::class_<TimedBand>(module, "TimedBand")
      .def(nb::init<>())
      .def("set_path", set_path, "path"_a, "settings"_a)
      .def(
          "move_ends",
          [](TimedBand& band, const BandPose& start, const BandPose& goal) {
            if (band.poses.size() < 3) throw nb::value_error("the band has no path");
            band.move_ends(start, goal);
          },
          "start"_a, "goal"_a)
      .def("optimize", optimize, "settings"_a, "body"_a, "obstacles"_a, "via_points"_a, nb::kw_only(), "velocity"_a,
           "obstacle_scale"_a = 1.0)
      .def_prop_ro("poses",
                   [](const TimedBand& band) {
                     std::vector<double> numbers;
                     for (const BandPose& pose : band.poses) numbers.insert(numbers.end(), pose.begin(), pose.end());
                     return array_of(std::move(numbers), 3);
                   })
      .def_prop_ro("steps", [](const TimedBand& band) { return nb::object(array_of(band.steps, 1).attr("ravel")()); });
  module.def("obstacle_outline", [](const Costs& costs) { return cells_of(costs, obstacle_outline); }, "costs"_a);
  module.def("obstacle_islands", [](const Costs& costs) { return cells_of(costs, obstacle_islands); }, "costs"_a);
  module.def("relax_bubbles", relax, "path"_a, "obstacles"_a, "settings"_a);
}
