#include <nanobind/nanobind.h>
#include <nanobind/stl/tuple.h>

#include <utility>
#include <vector>

#include "array_cast.h"
#include "path_timing.h"
#include "scene_bindings.h"

namespace trundle::planning {

namespace {

using namespace nb::literals;

nb::object result_of(TimedStates timed, std::size_t columns) {
  const std::size_t count = timed.times.size();
  return nb::make_tuple(owned_array(std::move(timed.times), {count}), table_of(timed.positions, columns),
                        table_of(timed.velocities, columns), table_of(timed.accelerations, columns));
}

MotionLimits limits_of(const Numbers& velocity, const Numbers& acceleration, std::size_t size) {
  const std::span<const double> v = span_of(velocity, size), a = span_of(acceleration, size);
  return {{v.begin(), v.end()}, {a.begin(), a.end()}};
}

nb::object optimal(const Table& waypoints, const Numbers& velocity, const Numbers& acceleration, double tolerance,
                   double step_s) {
  const std::size_t columns = waypoints.shape(1);
  const std::vector<State> states = states_of(waypoints, columns);
  const MotionLimits limits = limits_of(velocity, acceleration, columns);
  TimedStates timed;
  {
    const nb::gil_scoped_release unlocked;
    timed = time_optimal(BlendedPath(states, tolerance), limits, step_s);
  }
  return result_of(std::move(timed), columns);
}

nb::object parabolic(const Table& waypoints, const Numbers& velocity, const Numbers& acceleration) {
  const std::size_t columns = waypoints.shape(1);
  const std::vector<State> states = states_of(waypoints, columns);
  const MotionLimits limits = limits_of(velocity, acceleration, columns);
  TimedStates timed;
  {
    const nb::gil_scoped_release unlocked;
    timed = time_parabolic(states, limits);
  }
  return result_of(std::move(timed), columns);
}

}  // namespace

void bind_trajectories(nb::module_& module) {
  module.def("time_optimal", optimal, "waypoints"_a, "velocity"_a, "acceleration"_a, "tolerance"_a, "step_s"_a);
  module.def("time_parabolic", parabolic, "waypoints"_a, "velocity"_a, "acceleration"_a);
}

}  // namespace trundle::planning
