// Laws of ros_control's controllers, which command joints at every step.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "servo_joint.h"

namespace trundle {

class ServoLaw {
 public:
  ServoLaw() = default;
  ServoLaw(const ServoLaw&) = default;
  ServoLaw& operator=(const ServoLaw&) = default;
  virtual ~ServoLaw() = default;

  // Command the joints after a read, dt [s] after the last time; return false if Python has to be called.
  virtual bool update(std::int64_t time_ns, double dt) = 0;

  // Return a function that restores the law.
  virtual std::function<void()> checkpoint() = 0;

  std::int64_t time_ns = 0, period_ns = 0;  // time of the last update

 protected:
  void mark_update(std::int64_t time, double dt);
};

// PID loop around one joint.
class PidLoop : public ServoLaw {
 public:
  PidLoop(std::shared_ptr<ServoJoint> joint, std::shared_ptr<ToolboxPid> pid, bool of_speed)
      : joint_(std::move(joint)), pid_(std::move(pid)), of_speed_(of_speed) {}

  // Hold the current position, or zero velocity.
  void start(std::int64_t time_ns);

  // Error of the value, with the target within the joint's limits.
  double error();

  bool update(std::int64_t time_ns, double dt) override;
  std::function<void()> checkpoint() override;

  double target = 0.0;
  std::int64_t updates = 0;

 private:
  std::shared_ptr<ServoJoint> joint_;
  std::shared_ptr<ToolboxPid> pid_;
  bool of_speed_;
};

// Largest errors of a joint; 0: not checked.
struct StateTolerance {
  double position, velocity;

  bool allows(double position_error, double velocity_error) const;
};

// Segment of a joint's path: a polynomial from a start to an end time, at rest outside.
struct PathSegment {
  std::int64_t start_ns, end_ns;
  std::array<double, 6> coefficients;  // coefficients of the powers of the time since the start [s]
  std::int64_t goal;                   // number of the action's goal; 0: none
  StateTolerance along, at_end;
  std::int64_t tolerance_ns;  // time after the end in which the goal has to be reached
};

struct MotionState {
  double position, velocity, acceleration;
};

// Segments in order of their starts; each ends where the next one starts. At least one.
using JointPath = std::vector<PathSegment>;

// Follows a path with each joint, and checks the tolerances of an action's goal.
class TrajectoryLaw : public ServoLaw {
 public:
  enum class Outcome { kReached = 0, kOffPath = -4, kMissed = -5 };

  struct Event {
    Outcome outcome;
    std::size_t joint;
    double error;  // row of its position
  };

  // pids: of each joint; none: positions are commanded. forward: gains of the desired velocities.
  TrajectoryLaw(std::vector<std::shared_ptr<ServoJoint>> joints, std::vector<std::shared_ptr<ToolboxPid>> pids,
                std::vector<double> forward);

  void set_paths(std::vector<std::shared_ptr<const JointPath>> paths);

  // Follow a new goal.
  void begin_goal(std::int64_t goal);

  // Result of the watched goal, once.
  std::optional<Event> take_event();

  const std::vector<MotionState>& desired() const { return desired_; }

  // Set the desired states to the joints' states.
  void start(std::int64_t time_ns);

  bool update(std::int64_t time_ns, double dt) override;
  std::function<void()> checkpoint() override;

  bool watches = false;  // the goal is neither reached nor failed

 private:
  std::optional<Event> check(const std::vector<const PathSegment*>& segments);

  std::vector<std::shared_ptr<ServoJoint>> joints_;
  std::vector<std::shared_ptr<ToolboxPid>> pids_;
  std::vector<double> forward_;
  std::vector<std::shared_ptr<const JointPath>> paths_;
  std::vector<MotionState> desired_;
  std::vector<bool> arrived_;
  std::int64_t goal_ = 0;
  std::optional<Event> event_;
};

}  // namespace trundle
