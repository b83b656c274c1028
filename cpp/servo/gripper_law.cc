#include "gripper_law.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trundle {

void GripperLaw::start(std::int64_t time) {
  time_ns = time;
  period_ns = 0;
  joint_->start();
  hold();
  moved_ns_ = time;
  max_effort_ = 0.0;
  if (pid_) pid_->reset();
}

void GripperLaw::begin(double target, double max_effort, std::int64_t time) {
  target_ = target;
  max_effort_ = max_effort;
  moved_ns_ = time;
}

std::optional<bool> GripperLaw::take_event() { return std::exchange(event_, {}); }

bool GripperLaw::update(std::int64_t time, double dt) {
  mark_update(time, dt);
  const double error = joint_->error(target_);
  if (!pid_) {
    joint_->command = target_;
  } else {
    const double effort = pid_->command(error, dt, -joint_->velocity);
    joint_->command = max_effort_ > 0.0 ? std::min(std::max(effort, -max_effort_), max_effort_) : effort;
  }
  if (std::abs(joint_->velocity) > min_speed_ || time < moved_ns_) moved_ns_ = time;
  if (!watches) return true;
  if (std::abs(error) < tolerance_) event_ = true;
  else if (time - moved_ns_ > stall_ns_) event_ = false;
  watches = !event_;
  return watches;
}

std::function<void()> GripperLaw::checkpoint() {
  return [this, saved = *this, pid = pid_ ? *pid_ : ToolboxPid()] {
    *this = saved;
    if (pid_) *pid_ = pid;
  };
}

}  // namespace trundle
