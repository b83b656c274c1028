// Law of gripper_action_controller: moves a finger until it arrives or stalls.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "servo_laws.h"

namespace trundle {

class GripperLaw : public ServoLaw {
 public:
  // pid: efforts from the position's error; null: the position is commanded. A finger slower than min_speed for
  // longer than stall_ns has stalled.
  GripperLaw(std::shared_ptr<ServoJoint> joint, std::shared_ptr<ToolboxPid> pid, double tolerance, double min_speed,
             std::int64_t stall_ns)
      : joint_(std::move(joint)),
        pid_(std::move(pid)),
        tolerance_(tolerance),
        min_speed_(min_speed),
        stall_ns_(stall_ns) {}

  // Hold the current position.
  void start(std::int64_t time);

  // Move to a position with at most an effort; 0: unlimited.
  void begin(double target, double max_effort, std::int64_t time);

  // Stay at the current position.
  void hold() { target_ = joint_->position; }

  // Result of the watched goal, once: true if it was reached, false if the finger stalled.
  std::optional<bool> take_event();

  bool update(std::int64_t time, double dt) override;
  std::function<void()> checkpoint() override;

  bool watches = false;  // the goal is neither reached nor stalled

 private:
  std::shared_ptr<ServoJoint> joint_;
  std::shared_ptr<ToolboxPid> pid_;
  double tolerance_, min_speed_;
  std::int64_t stall_ns_;
  double target_ = 0.0, max_effort_ = 0.0;
  std::int64_t moved_ns_ = 0;
  std::optional<bool> event_;
};

}  // namespace trundle
