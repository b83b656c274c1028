#include "drive_law.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trundle {

double SpeedLimit::limit(double target, double last, double before_last, double dt) const {
  if (std::isfinite(max_jerk) || std::isfinite(min_jerk)) {
    const double change = target - last, before = last - before_last, twice = 2.0 * dt * dt;
    target = last + before + std::min(std::max(change - before, min_jerk * twice), max_jerk * twice);
  }
  target = last + std::min(std::max(target - last, min_acceleration * dt), max_acceleration * dt);
  return std::min(std::max(target, min_velocity), max_velocity);
}

DiffDriveLaw::DiffDriveLaw(Joints left, Joints right, const DriveGeometry& geometry,
                           const std::array<SpeedLimit, 2>& limits, std::int64_t timeout_ns, bool open_loop,
                           std::size_t window)
    : left_(std::move(left)),
      right_(std::move(right)),
      geometry_(geometry),
      limits_(limits),
      timeout_ns_(timeout_ns),
      open_loop_(open_loop),
      window_(window) {
  if (left_.empty() || right_.empty()) throw std::invalid_argument("a wheel on each side");
}

void DiffDriveLaw::start() {
  for (const Joints* side : {&left_, &right_})
    for (const auto& joint : *side) joint->start();
  wheel_angles_ = turns();
  command_.reset();
}

std::pair<double, double> DiffDriveLaw::turns() const {
  const auto mean = [](const Joints& side) {
    double sum = 0.0;
    for (const auto& joint : side) sum += joint->position;
    return sum / static_cast<double>(side.size());
  };
  return {mean(left_), mean(right_)};
}

// Add the wheels' motion since the last update to the odometry: an arc as a chord along the mean heading, exact in yaw,
// third-order in position.
void DiffDriveLaw::count(double dt) {
  double left, right;
  if (open_loop_) {
    const auto [linear, angular] = limited();
    const double half = angular * geometry_.separation / 2;
    left = (linear - half) * dt;
    right = (linear + half) * dt;
  } else {
    const auto now = turns();
    left = (now.first - wheel_angles_.first) * geometry_.left_radius;
    right = (now.second - wheel_angles_.second) * geometry_.right_radius;
    wheel_angles_ = now;
  }
  left = left / geometry_.wheel_radius * geometry_.wheel_radius;  // as the rotation of a wheel
  right = right / geometry_.wheel_radius * geometry_.wheel_radius;
  const double distance = (left + right) / 2, turn = (right - left) / geometry_.separation;
  pose_.x += distance * std::cos(pose_.yaw + turn / 2);
  pose_.y += distance * std::sin(pose_.yaw + turn / 2);
  pose_.yaw += turn;
  speeds_.push_back({distance / dt, turn / dt});
  if (speeds_.size() > window_) speeds_.pop_front();
}

// Last command, or zero if it has timed out.
DiffDriveLaw::Twist DiffDriveLaw::current_command() const {
  return command_ && time_ns - command_->first <= timeout_ns_ ? command_->second : Twist{0.0, 0.0};
}

bool DiffDriveLaw::update(std::int64_t time, double dt) {
  mark_update(time, dt);
  count(dt);
  const Twist target = current_command();
  const double targets[2] = {target.linear, target.angular};
  for (std::size_t i = 0; i < 2; ++i) {
    History& history = history_[i];
    history = {limits_[i].limit(targets[i], history.last, history.before, dt), history.last};
  }
  const auto [linear, angular] = limited();
  const double half = angular * geometry_.separation / 2;
  for (const auto& joint : left_) joint->command = (linear - half) / geometry_.left_radius;
  for (const auto& joint : right_) joint->command = (linear + half) / geometry_.right_radius;
  return true;
}

}  // namespace trundle
