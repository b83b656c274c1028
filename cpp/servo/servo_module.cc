// The Python module `_servo`: laws of ros_control, which act before each step of the engine.
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "drive_law.h"
#include "gripper_law.h"
#include "servo.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle {

namespace {

using Axis = std::tuple<std::shared_ptr<MotorBank>, int, int, int, double>;
using Segment =
    std::tuple<std::int64_t, std::int64_t, std::array<double, 6>, std::int64_t, std::array<double, 4>, std::int64_t>;
using State = std::tuple<double, double, double>;
using Event = std::tuple<int, std::size_t, double>;

ServoAxis axis_of(const Axis& axis) {
  const auto& [bank, index, qpos, dof, sign] = axis;
  if (!bank) throw nb::value_error("an axis has a bank");
  return {bank, index, qpos, dof, sign};
}

// Function that restores an object, and holds it.
template <typename Saved>
nb::object checkpoint(nb::handle_t<Saved> self) {
  return nb::cpp_function([owner = nb::borrow(self), restore = nb::cast<Saved&>(self).checkpoint()] { restore(); });
}

nb::object checkpoint_pid(nb::handle_t<ToolboxPid> self) {
  return nb::cpp_function(
      [owner = nb::borrow(self), saved = nb::cast<ToolboxPid&>(self)] { nb::cast<ToolboxPid&>(owner) = saved; });
}

void make_pid(ToolboxPid* self, double p, double i, double d, double i_clamp, bool antiwindup) {
  new (self) ToolboxPid{p, i, d, i_clamp, antiwindup};
}

void make_joint(ServoJoint* self, const Axis& axis, int interface_, std::shared_ptr<ToolboxPid> pid, double lag_s,
                std::tuple<double, double> range, double max_effort, double max_speed, bool is_continuous,
                bool is_prismatic) {
  const auto [lower, upper] = range;
  const JointTraits traits{lower, upper, max_effort, max_speed, is_continuous, is_prismatic};
  new (self) ServoJoint(axis_of(axis), static_cast<Interface>(interface_), std::move(pid), traits, lag_s);
}

std::shared_ptr<JointPath> path_of(const std::vector<Segment>& segments) {
  auto path = std::make_shared<JointPath>();
  path->reserve(segments.size());
  for (const auto& [start_ns, end_ns, coefficients, goal, limits, tolerance_ns] : segments)
    path->push_back(
        {start_ns, end_ns, coefficients, goal, {limits[0], limits[1]}, {limits[2], limits[3]}, tolerance_ns});
  return path;
}

void set_paths(TrajectoryLaw& law, const std::vector<std::vector<Segment>>& paths) {
  std::vector<std::shared_ptr<const JointPath>> joint_paths;
  for (const auto& segments : paths) joint_paths.push_back(path_of(segments));
  law.set_paths(std::move(joint_paths));
}

std::vector<State> desired_of(const TrajectoryLaw& law) {
  std::vector<State> states;
  for (const MotionState& state : law.desired())
    states.emplace_back(state.position, state.velocity, state.acceleration);
  return states;
}

std::optional<Event> take_event(TrajectoryLaw& law) {
  const auto event = law.take_event();
  if (!event) return {};
  return Event{static_cast<int>(event->outcome), event->joint, event->error};
}

void bind_joints(nb::module_& module) {
  nb::class_<ToolboxPid>(module, "ToolboxPid")
      .def("__init__", make_pid, nb::kw_only(), "p"_a = 0.0, "i"_a = 0.0, "d"_a = 0.0, "i_clamp"_a = 0.0,
           "antiwindup"_a = false)
      .def_rw("p", &ToolboxPid::p)
      .def_rw("i", &ToolboxPid::i)
      .def_rw("d", &ToolboxPid::d)
      .def_rw("i_clamp", &ToolboxPid::i_clamp)
      .def_rw("antiwindup", &ToolboxPid::antiwindup)
      .def("reset", &ToolboxPid::reset)
      .def("command", &ToolboxPid::command, "error"_a, "dt"_a, nb::kw_only(), "slope"_a = nb::none())
      .def("checkpoint", checkpoint_pid);
  nb::class_<ServoJoint>(module, "ServoJoint")
      .def("__init__", make_joint, "axis"_a, "interface"_a, "pid"_a.none(), nb::kw_only(), "lag_s"_a, "range"_a,
           "max_effort"_a, "max_speed"_a, "is_continuous"_a, "is_prismatic"_a)
      .def(
          "bind", [](ServoJoint& self, const Axis& axis) { self.bind(axis_of(axis)); }, "axis"_a)
      .def_rw("command", &ServoJoint::command)
      .def_rw("lag_s", &ServoJoint::lag_s)
      .def_ro("position", &ServoJoint::position)
      .def_ro("velocity", &ServoJoint::velocity)
      .def_ro("effort", &ServoJoint::effort)
      .def_prop_ro("lower", [](const ServoJoint& self) { return self.traits().lower; })
      .def_prop_ro("upper", [](const ServoJoint& self) { return self.traits().upper; })
      .def_prop_ro("is_continuous", [](const ServoJoint& self) { return self.traits().is_continuous; })
      .def_prop_ro("settling_ns", &ServoJoint::settling_ns)
      .def_prop_ro("resting_command", &ServoJoint::resting_command)
      .def("read", &ServoJoint::read)
      .def("error", &ServoJoint::error, "position"_a)
      .def("shortest_error", &ServoJoint::shortest_error, "position"_a)
      .def("stop", &ServoJoint::stop)
      .def("start", &ServoJoint::start)
      .def("write", &ServoJoint::write, "dt"_a)
      .def("checkpoint", checkpoint<ServoJoint>);
}

void bind_laws(nb::module_& module) {
  nb::class_<ServoLaw>(module, "ServoLaw")
      .def_ro("time_ns", &ServoLaw::time_ns)
      .def_ro("period_ns", &ServoLaw::period_ns)
      .def("update", &ServoLaw::update, "time_ns"_a, "dt"_a)
      .def("checkpoint", checkpoint<ServoLaw>);
  nb::class_<PidLoop, ServoLaw>(module, "PidLoop")
      .def(nb::init<std::shared_ptr<ServoJoint>, std::shared_ptr<ToolboxPid>, bool>(), "joint"_a, "pid"_a, "of_speed"_a)
      .def("start", &PidLoop::start, "time_ns"_a)
      .def("error", &PidLoop::error)
      .def_rw("target", &PidLoop::target)
      .def_ro("updates", &PidLoop::updates);
  nb::class_<TrajectoryLaw, ServoLaw>(module, "TrajectoryLaw")
      .def(nb::init<std::vector<std::shared_ptr<ServoJoint>>, std::vector<std::shared_ptr<ToolboxPid>>,
                    std::vector<double>>(),
           "joints"_a, "pids"_a, "forward"_a)
      .def("set_paths", set_paths, "paths"_a)
      .def("begin_goal", &TrajectoryLaw::begin_goal, "goal"_a)
      .def_rw("watches", &TrajectoryLaw::watches)
      .def("take_event", take_event)
      .def_prop_ro("desired", desired_of)
      .def("start", &TrajectoryLaw::start, "time_ns"_a);
}

void bind_gripper(nb::module_& module) {
  nb::class_<GripperLaw, ServoLaw>(module, "GripperLaw")
      .def(nb::init<std::shared_ptr<ServoJoint>, std::shared_ptr<ToolboxPid>, double, double, std::int64_t>(),
           "joint"_a, "pid"_a.none(), nb::kw_only(), "tolerance"_a, "min_speed"_a, "stall_ns"_a)
      .def("start", &GripperLaw::start, "time_ns"_a)
      .def("begin", &GripperLaw::begin, "target"_a, "max_effort"_a, "time_ns"_a)
      .def("hold", &GripperLaw::hold)
      .def_rw("watches", &GripperLaw::watches)
      .def("take_event", &GripperLaw::take_event);
}

using Pair = std::tuple<double, double>;

void make_drive(DiffDriveLaw* self, DiffDriveLaw::Joints left, DiffDriveLaw::Joints right, double wheel_radius,
                double separation, const Pair& radii, const std::array<std::array<double, 6>, 2>& limits,
                std::int64_t timeout_ns, bool open_loop, std::size_t window) {
  const auto limit = [](const std::array<double, 6>& of) {
    return SpeedLimit{of[0], of[1], of[2], of[3], of[4], of[5]};
  };
  const auto [left_radius, right_radius] = radii;
  new (self) DiffDriveLaw(std::move(left), std::move(right), {wheel_radius, separation, left_radius, right_radius},
                          {limit(limits[0]), limit(limits[1])}, timeout_ns, open_loop, window);
}

std::vector<Pair> speeds_of(const DiffDriveLaw& law) {
  std::vector<Pair> speeds;
  for (const auto& [linear, angular] : law.speeds()) speeds.emplace_back(linear, angular);
  return speeds;
}

void bind_drive(nb::module_& module) {
  nb::class_<DiffDriveLaw, ServoLaw>(module, "DiffDriveLaw")
      .def("__init__", make_drive, "left"_a, "right"_a, nb::kw_only(), "wheel_radius"_a, "separation"_a, "radii"_a,
           "limits"_a, "timeout_ns"_a, "open_loop"_a, "window"_a)
      .def("start", &DiffDriveLaw::start)
      .def(
          "set_command",
          [](DiffDriveLaw& self, std::int64_t stamp_ns, double linear, double angular) {
            self.set_command(stamp_ns, {linear, angular});
          },
          "stamp_ns"_a, "linear"_a, "angular"_a)
      .def_prop_ro("pose",
                   [](const DiffDriveLaw& self) { return State{self.pose().x, self.pose().y, self.pose().yaw}; })
      .def_prop_ro("speeds", speeds_of)
      .def_prop_ro("limited",
                   [](const DiffDriveLaw& self) { return Pair{self.limited().linear, self.limited().angular}; });
}

void bind_actions(nb::module_& module) {
  nb::class_<ServoHardware>(module, "ServoHardware");
  nb::class_<Servo, StepAction>(module, "Servo")
      .def(nb::init<std::vector<std::shared_ptr<ServoJoint>>>(), "joints"_a)
      .def("set_laws", &Servo::set_laws, "laws"_a)
      .def("set_hardware", &Servo::set_hardware, "hardware"_a.none())
      .def("restart", &Servo::restart, "time_ns"_a)
      .def("read", &Servo::read, "time_ns"_a, "step_ns"_a, nb::call_guard<nb::gil_scoped_release>())
      .def("update", &Servo::update, "dt"_a, nb::call_guard<nb::gil_scoped_release>())
      .def("write", &Servo::write, "dt"_a, nb::call_guard<nb::gil_scoped_release>())
      .def_prop_ro("time_ns", &Servo::time_ns)
      .def_rw("longest_ns", &Servo::longest_ns);
  nb::class_<MimicAction, StepAction>(module, "MimicAction")
      .def(
          "__init__",
          [](MimicAction* self, const Axis& leader, const Axis& follower, double multiplier, double offset,
             double min_error, double max_effort, std::int64_t lag_steps) {
            new (self)
                MimicAction(axis_of(leader), axis_of(follower), multiplier, offset, min_error, max_effort, lag_steps);
          },
          "leader"_a, "follower"_a, nb::kw_only(), "multiplier"_a, "offset"_a, "min_error"_a, "max_effort"_a,
          "lag_steps"_a);
}

}  // namespace

}  // namespace trundle

NB_MODULE(_servo, module) {
  nb::module_::import_("trundle.sim.physics._contact_laws");  // has the base classes
  trundle::bind_joints(module);
  trundle::bind_laws(module);
  trundle::bind_gripper(module);
  trundle::bind_drive(module);
  trundle::bind_actions(module);
}
