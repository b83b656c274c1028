// States and motions of a group that are within limits, without collision, and as the path constraints want them.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <span>
#include <vector>

#include "collision_world.h"
#include "pose_constraint.h"
#include "state_space.h"

namespace trundle::planning {

// End of the time that a planner has; another thread may end it at once.
class Deadline {
 public:
  explicit Deadline(double seconds, std::shared_ptr<std::atomic<bool>> cancelled = nullptr);
  bool is_over() const;
  double remaining() const;  // [s]

 private:
  std::chrono::steady_clock::time_point end_;
  std::shared_ptr<std::atomic<bool>> cancelled_;
};

struct GroupTask {
  StateSpace space;
  std::vector<int> variables;  // of the group, in a state
  State reference;             // of all variables; those of the group are replaced
  LinkMask mask;               // links that move with the group
  ConstraintSet path;
  double resolution = 0.05;  // greatest distance of states that are checked, in the space
  double sweep = 0.002;      // motion of a link's points up to which nothing between two states is looked at [m]
  bool avoids_collisions = true;
};

class Validity {
 public:
  Validity(CollisionWorld& world, GroupTask task);

  const GroupTask& task() const { return task_; }
  const StateSpace& space() const { return task_.space; }
  CollisionWorld& world() { return world_; }
  bool is_constrained() const { return !task_.path.poses.empty(); }
  void set_resolution(double resolution) { task_.resolution = resolution; }

  // All variables with those of the group as given.
  const State& full(std::span<const double> group);

  bool is_valid(std::span<const double> group);
  bool is_free(std::span<const double> group);
  bool keeps_constraints(std::span<const double> group);
  // Move onto the path constraints; false: not possible.
  bool project(std::span<double> group, std::span<const PoseConstraint> more = {});

  // The motion between two valid states: at steps of the resolution, the middle first. Finely: between those, too,
  // where the links could reach something (Schwarzer, Saha and Latombe 2005).
  bool is_motion_valid(std::span<const double> a, std::span<const double> b, bool finely);

  long long checks = 0;  // of states

 private:
  // Number of parts into which a motion is divided.
  int parts(std::span<const double> a, std::span<const double> b) const;
  // Put into `swept_` how far things move in a motion.
  void find_swept(std::span<const double> a, std::span<const double> b);
  bool is_part_valid(std::span<const double> a, std::span<const double> b, double from, double to);

  CollisionWorld& world_;
  GroupTask task_;
  State full_, between_;
  Projection projection_;
  std::vector<MotionBounds> reach_;  // per unit of each variable
  MotionBounds swept_;
  double greatest_ = 0.0;  // of `swept_`
  std::vector<Rigid> poses_;
};

}  // namespace trundle::planning
