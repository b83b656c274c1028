#include "servo.h"

#include <algorithm>
#include <cmath>

namespace trundle {

double Servo::read(std::int64_t time_ns, std::int64_t step_ns) {
  const std::int64_t passed_ns = std::min(time_ns - time_ns_, longest_ns + step_ns);
  time_ns_ = time_ns;
  if (passed_ns <= 0) return 0.0;
  if (hardware_) hardware_->read(time_ns, passed_ns);
  for (const auto& joint : joints_) joint->read();
  return static_cast<double>(passed_ns) / 1e9;
}

bool Servo::update(double dt) {
  bool goes_on = true;
  for (const auto& law : laws_) goes_on &= law->update(time_ns_, dt);
  return goes_on;
}

void Servo::write(double dt) {
  for (const auto& joint : joints_) joint->write(dt);
  if (hardware_) hardware_->write(time_ns_, std::llround(dt * 1e9));
}

bool Servo::act(std::int64_t time_ns, std::int64_t step_ns) {
  const double dt = read(time_ns, step_ns);
  if (dt <= 0.0) return true;
  const bool goes_on = update(dt);
  write(dt);
  return goes_on;
}

std::function<void()> Servo::checkpoint() {
  std::vector<std::function<void()>> restores;
  for (const auto& law : laws_) restores.push_back(law->checkpoint());
  for (const auto& joint : joints_) restores.push_back(joint->checkpoint());
  if (hardware_) restores.push_back(hardware_->checkpoint());
  return [this, saved = *this, restores] {
    *this = saved;
    for (const auto& restore : restores) restore();
  };
}

bool MimicAction::act(std::int64_t, std::int64_t step_ns) {
  const auto position_of = [](const ServoAxis& axis) { return axis.bank->data()->qpos[axis.qpos] * axis.sign; };
  const double error = position_of(leader) * multiplier + offset - position_of(follower);
  if (std::abs(error) < min_error) return true;
  const double speed = error * 1e9 / static_cast<double>(lag_steps * step_ns);
  follower.bank->command_velocity(follower.axis, speed, max_effort, false);
  return true;
}

}  // namespace trundle
