#include <nanobind/ndarray.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "array_cast.h"
#include "motion_query.h"
#include "pose_follower.h"
#include "scene_bindings.h"

namespace trundle::planning {

namespace {

using namespace nb::literals;
using Flags = nb::ndarray<const bool, nb::numpy, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

constexpr double kMaxSeconds = 86400.0;

// Ends a search from another thread.
struct CancelFlag {
  std::shared_ptr<std::atomic<bool>> flag = std::make_shared<std::atomic<bool>>(false);
};

PoseConstraint pose_constraint(int link, int frame, const Numbers& offset, const std::vector<CollisionShape>& regions,
                               const Rows<7>& region_poses, int orientation, const Numbers& target,
                               const Numbers& tolerance) {
  PoseConstraint constraint;
  constraint.link = link;
  constraint.frame = frame;
  constraint.offset = vector_of(offset);
  const std::vector<Rigid> poses = poses_of(region_poses);
  if (poses.size() != regions.size()) throw nb::value_error("each region has a pose");
  for (std::size_t i = 0; i < regions.size(); ++i)
    for (const auto& part : regions[i].parts) constraint.regions.push_back({part, poses[i]});
  constraint.orientation = static_cast<OrientationError>(std::clamp(orientation, 0, 2));
  const std::span<const double> q = span_of(target, 4);
  constraint.target = rotation_of(q[0], q[1], q[2], q[3]);
  constraint.tolerance = vector_of(tolerance);
  return constraint;
}

VisibilityConstraint visibility_constraint(int sensor_link, int target_link, const Rows<7>& poses, int view_axis,
                                           double radius, int sides, double max_view_angle, double max_range_angle) {
  const std::vector<Rigid> both = poses_of(poses);
  if (both.size() != 2) throw nb::value_error("poses of a sensor and of a target");
  return {
      sensor_link,    target_link,    both[0], both[1], std::clamp(view_axis, 0, 2), radius, std::clamp(sides, 3, 64),
      max_view_angle, max_range_angle};
}

void check_links(const ConstraintSet& set, const LinkTree& tree) {
  const int count = static_cast<int>(tree.size());
  for (const PoseConstraint& constraint : set.poses)
    if (constraint.link < 0 || constraint.link >= count || constraint.frame >= count)
      throw nb::value_error("a constraint names a link that there is not");
  for (const VisibilityConstraint& constraint : set.visibilities)
    if (constraint.sensor_link >= count || constraint.target_link >= count)
      throw nb::value_error("a constraint names a link that there is not");
}

// Group, limits and path constraints of a query.
GroupTask group_task(const Rows<4>& dimensions, const std::vector<int>& variables, const Numbers& reference,
                     const Flags& links, const std::vector<PoseConstraint>& poses,
                     const std::vector<VisibilityConstraint>& visibilities, double segment_fraction, double sweep,
                     bool avoids_collisions) {
  if (variables.size() != dimensions.shape(0) || variables.empty()) throw nb::value_error("each variable has limits");
  GroupTask task;
  std::vector<Dimension> made;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (variables[i] < 0 || static_cast<std::size_t>(variables[i]) >= reference.size())
      throw nb::value_error("no such variable");
    made.push_back({dimensions(i, 0), dimensions(i, 1), dimensions(i, 2) != 0.0, dimensions(i, 3) != 0.0});
  }
  task.space = StateSpace(std::move(made));
  task.variables = variables;
  const std::span<const double> state = span_of(reference, reference.size());
  task.reference.assign(state.begin(), state.end());
  task.mask.assign(links.data(), links.data() + links.size());
  task.path = {poses, visibilities};
  task.resolution = std::max(segment_fraction * task.space.extent(), 1e-4);
  task.sweep = std::max(sweep, 1e-4);
  task.avoids_collisions = avoids_collisions;
  return task;
}

Goal goal(const Rows<4>& joints, const std::vector<PoseConstraint>& poses,
          const std::vector<VisibilityConstraint>& visibilities) {
  Goal made;
  for (std::size_t i = 0; i < joints.shape(0); ++i)
    made.joints.push_back({static_cast<std::size_t>(joints(i, 0)), joints(i, 1), joints(i, 2), joints(i, 3)});
  made.constraints = {poses, visibilities};
  return made;
}

struct QueryResult {
  std::vector<State> states;
  std::size_t columns = 0;
  long long iterations = 0, checks = 0, attempts = 0, unreachable = 0, in_collision = 0;
  std::size_t nodes = 0;
  int goals = 0;
  double seconds_left = 0.0;
};

void check_task(const SharedWorld& shared, const GroupTask& task) {
  if (task.reference.size() != shared.variables) throw nb::value_error("a state has one number for each variable");
  if (!task.mask.empty() && task.mask.size() != shared.world.tree().size())
    throw nb::value_error("a mask has one flag for each link");
  check_links(task.path, shared.world.tree());
}

QueryResult find(SharedWorld& shared, const GroupTask& task, const Numbers& start, const std::vector<Goal>& goals,
                 int algorithm, double range, double goal_bias, int max_iterations, int max_goals, bool simplifies,
                 std::uint64_t seed, double seconds, const CancelFlag& cancel) {
  check_task(shared, task);
  for (const Goal& each : goals) {
    check_links(each.constraints, shared.world.tree());
    for (const JointBound& joint : each.joints)
      if (joint.variable >= task.space.size()) throw nb::value_error("no such variable in the group");
  }
  const std::span<const double> from = span_of(start, task.space.size());
  MotionQuery query;
  query.planner.algorithm = static_cast<Algorithm>(std::clamp(algorithm, 0, 4));
  query.planner.range = range;
  query.planner.goal_bias = goal_bias;
  query.planner.max_iterations = max_iterations;
  query.planner.max_goals = std::max(1, max_goals);
  query.simplifies = simplifies;
  const nb::gil_scoped_release unlocked;
  const std::scoped_lock lock(shared.mutex);
  const Deadline deadline(std::clamp(seconds, 0.0, kMaxSeconds), cancel.flag);
  Validity validity(shared.world, task);
  GoalRegion region(goals, from);
  Random random(seed);
  PlannedPath path = solve(validity, from, region, query, random, deadline);
  QueryResult result;
  result.states = std::move(path.states);
  result.columns = task.space.size();
  result.iterations = path.iterations;
  result.nodes = path.nodes;
  result.goals = path.goals;
  result.checks = validity.checks;
  result.attempts = region.attempts;
  result.unreachable = region.unreachable;
  result.in_collision = region.in_collision;
  result.seconds_left = deadline.remaining();
  return result;
}

// Number of the first part of a path that is not valid; −1: none.
int first_invalid(SharedWorld& shared, const GroupTask& task, const Table& states) {
  check_task(shared, task);
  const std::vector<State> path = states_of(states, task.space.size());
  const nb::gil_scoped_release unlocked;
  const std::scoped_lock lock(shared.mutex);
  Validity validity(shared.world, task);
  return find_invalid_part(validity, path);
}

// 0: valid; 1: beyond limits; 2: against the path constraints; 3: in collision.
int fault_of(SharedWorld& shared, const GroupTask& task, const Numbers& state) {
  check_task(shared, task);
  const std::span<const double> group = span_of(state, task.space.size());
  const nb::gil_scoped_release unlocked;
  const std::scoped_lock lock(shared.mutex);
  Validity validity(shared.world, task);
  if (!task.space.is_within(group, 1e-9)) return 1;
  if (!validity.keeps_constraints(group)) return 2;
  return validity.is_free(group) ? 0 : 3;
}

bool satisfies(SharedWorld& shared, const GroupTask& task, const Goal& wanted, const Numbers& state) {
  check_task(shared, task);
  check_links(wanted.constraints, shared.world.tree());
  const std::span<const double> group = span_of(state, task.space.size());
  const nb::gil_scoped_release unlocked;
  const std::scoped_lock lock(shared.mutex);
  Validity validity(shared.world, task);
  return GoalRegion({wanted}, group).is_satisfied(validity, group);
}

nb::object valid_near(SharedWorld& shared, const GroupTask& task, const Numbers& state, double radius, int attempts,
                      std::uint64_t seed) {
  check_task(shared, task);
  const std::span<const double> group = span_of(state, task.space.size());
  State found;
  {
    const nb::gil_scoped_release unlocked;
    const std::scoped_lock lock(shared.mutex);
    Validity validity(shared.world, task);
    Random random(seed);
    found = find_valid_near(validity, group, radius, attempts, random);
  }
  if (found.empty()) return nb::none();
  const std::size_t size = found.size();
  return owned_array(std::move(found), {size});
}

// States of a goal, at most `count`, by at most `attempts` samples.
nb::object goal_states(SharedWorld& shared, const GroupTask& task, const Numbers& start, const std::vector<Goal>& goals,
                       int count, int attempts, std::uint64_t seed) {
  check_task(shared, task);
  for (const Goal& each : goals) check_links(each.constraints, shared.world.tree());
  const std::span<const double> from = span_of(start, task.space.size());
  std::vector<State> found;
  {
    const nb::gil_scoped_release unlocked;
    const std::scoped_lock lock(shared.mutex);
    Validity validity(shared.world, task);
    GoalRegion region(goals, from);
    Random random(seed);
    State state(task.space.size());
    for (int i = 0; i < attempts && static_cast<int>(found.size()) < count; ++i)
      if (region.sample(validity, random, state)) found.push_back(state);
  }
  return table_of(found, task.space.size());
}

nb::object follow(SharedWorld& shared, const GroupTask& task, const Numbers& start, int link, const Numbers& offset,
                  const Rows<7>& poses, const Flags& is_prismatic, double revolute_jump, double prismatic_jump) {
  check_task(shared, task);
  if (link < 0 || link >= static_cast<int>(shared.world.tree().size())) throw nb::value_error("no such link");
  if (is_prismatic.size() != task.space.size()) throw nb::value_error("a flag for each variable");
  const std::span<const double> from = span_of(start, task.space.size());
  const std::vector<Rigid> targets = poses_of(poses);
  const Vec3 point = vector_of(offset);
  const std::vector<bool> slides(is_prismatic.data(), is_prismatic.data() + is_prismatic.size());
  FollowedPath followed;
  {
    const nb::gil_scoped_release unlocked;
    const std::scoped_lock lock(shared.mutex);
    Validity validity(shared.world, task);
    followed = follow_poses(validity, from, link, point, targets, slides, {revolute_jump, prismatic_jump});
  }
  return nb::make_tuple(table_of(followed.states, task.space.size()), static_cast<int>(followed.end));
}

}  // namespace

void bind_planners(nb::module_& module) {
  nb::class_<CancelFlag>(module, "CancelFlag")
      .def(nb::init<>())
      .def("cancel", [](CancelFlag& self) { self.flag->store(true); })
      .def_prop_ro("is_cancelled", [](const CancelFlag& self) { return self.flag->load(); });
  nb::class_<PoseConstraint>(module, "PoseConstraint");
  nb::class_<VisibilityConstraint>(module, "VisibilityConstraint");
  nb::class_<Goal>(module, "Goal");
  nb::class_<GroupTask>(module, "GroupTask");
  nb::class_<QueryResult>(module, "QueryResult")
      .def_prop_ro("states", [](const QueryResult& self) { return table_of(self.states, self.columns); })
      .def_ro("iterations", &QueryResult::iterations)
      .def_ro("checks", &QueryResult::checks)
      .def_ro("nodes", &QueryResult::nodes)
      .def_ro("goals", &QueryResult::goals)
      .def_ro("attempts", &QueryResult::attempts)
      .def_ro("unreachable", &QueryResult::unreachable)
      .def_ro("in_collision", &QueryResult::in_collision)
      .def_ro("seconds_left", &QueryResult::seconds_left);
  module.def("pose_constraint", pose_constraint, "link"_a, "frame"_a, "offset"_a, "regions"_a, "region_poses"_a,
             "orientation"_a, "target"_a, "tolerance"_a);
  module.def("visibility_constraint", visibility_constraint, "sensor_link"_a, "target_link"_a, "poses"_a, "view_axis"_a,
             "radius"_a, "sides"_a, "max_view_angle"_a, "max_range_angle"_a);
  module.def("group_task", group_task, "dimensions"_a, "variables"_a, "reference"_a, "links"_a, "poses"_a,
             "visibilities"_a, "segment_fraction"_a, "sweep"_a, "avoids_collisions"_a);
  module.def("goal", goal, "joints"_a, "poses"_a, "visibilities"_a);
  module.def("find_path", find, "world"_a, "task"_a, "start"_a, "goals"_a, "algorithm"_a, "range"_a, "goal_bias"_a,
             "max_iterations"_a, "max_goals"_a, "simplifies"_a, "seed"_a, "seconds"_a, "cancel"_a);
  module.def("first_invalid", first_invalid, "world"_a, "task"_a, "states"_a);
  module.def("fault_of", fault_of, "world"_a, "task"_a, "state"_a);
  module.def("satisfies", satisfies, "world"_a, "task"_a, "goal"_a, "state"_a);
  module.def("valid_near", valid_near, "world"_a, "task"_a, "state"_a, "radius"_a, "attempts"_a, "seed"_a);
  module.def("goal_states", goal_states, "world"_a, "task"_a, "start"_a, "goals"_a, "count"_a, "attempts"_a, "seed"_a);
  module.def("follow_poses", follow, "world"_a, "task"_a, "start"_a, "link"_a, "offset"_a, "poses"_a, "is_prismatic"_a,
             "revolute_jump"_a, "prismatic_jump"_a);
}

}  // namespace trundle::planning
