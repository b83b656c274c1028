#include "servo_joint.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "contact/midpoint.h"

namespace trundle {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::int64_t kSettlingNs = 200'000'000;

}  // namespace

ServoJoint::ServoJoint(ServoAxis axis, Interface interface, std::shared_ptr<ToolboxPid> pid, const JointTraits& traits,
                       double lag_s)
    : lag_s(lag_s), interface_(interface), pid_(std::move(pid)), traits_(traits) {
  bind(std::move(axis));
}

void ServoJoint::bind(ServoAxis axis) {
  const auto within = [](int index, int count) { return index >= 0 && index < count; };
  const mjModel* m = axis.bank->model();
  if (!within(axis.axis, axis.bank->axis_count()) || !within(axis.qpos, m->nq) || !within(axis.dof, m->nv))
    throw std::invalid_argument("no such axis");
  axis_ = std::move(axis);
}

void ServoJoint::read() {
  if (numbers_.command) {
    position = *numbers_.position;
    velocity = *numbers_.velocity;
    effort = *numbers_.effort;
    return;
  }
  const mjData* d = axis_.bank->data();
  position = d->qpos[axis_.qpos] * axis_.sign;
  velocity = velocity_at(axis_.bank->model(), d, axis_.dof) * axis_.sign;
  effort = (d->qfrc_applied[axis_.dof] + d->qfrc_actuator[axis_.dof]) * axis_.sign;
}

double ServoJoint::error(double target) const {
  const double difference = target - position;
  return traits_.is_continuous ? std::remainder(difference, kTurn) : difference;
}

double ServoJoint::shortest_error(double target) const {
  const double difference = target - position;
  return traits_.is_prismatic ? difference : std::remainder(difference, kTurn);
}

std::int64_t ServoJoint::settling_ns() const { return interface_ == Interface::kPosition && !pid_ ? kSettlingNs : 0; }

void ServoJoint::stop() {
  is_at_rest_ = true;
  if (interface_ != Interface::kPosition) command = 0.0;
  if (pid_) pid_->reset();
}

void ServoJoint::start() {
  is_at_rest_ = false;
  command = resting_command();
}

void ServoJoint::write(double dt) {
  if (numbers_.command) {
    *numbers_.command = command;
    return;
  }
  switch (interface_) {
    case Interface::kEffort: axis_.bank->command_effort(axis_.axis, command, true); break;
    case Interface::kVelocity: write_velocity(dt); break;
    case Interface::kPosition: write_position(dt); break;
  }
}

void ServoJoint::write_velocity(double dt) {
  const double target = std::min(std::max(command, -traits_.max_speed), traits_.max_speed);
  if (pid_) axis_.bank->command_effort(axis_.axis, pid_->command(target - velocity, dt), true);
  else axis_.bank->command_velocity(axis_.axis, target, traits_.max_effort, true);
}

void ServoJoint::write_position(double dt) {
  // The position was set while no controller ran.
  if (is_at_rest_ && velocity == 0.0 && error(command) != 0.0) command = position;
  const double off = error(std::min(std::max(command, traits_.lower), traits_.upper));
  if (pid_) {
    axis_.bank->command_effort(axis_.axis, pid_->command(off, dt), true);
    return;
  }
  const double speed = std::min(std::max(off / lag_s, -traits_.max_speed), traits_.max_speed);
  axis_.bank->drive_kinematically(axis_.axis, speed, true);
}

std::function<void()> ServoJoint::checkpoint() {
  return [this, saved = *this, pid = pid_ ? *pid_ : ToolboxPid()] {
    *this = saved;
    if (pid_) *pid_ = pid;
  };
}

}  // namespace trundle
