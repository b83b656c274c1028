#include "motor_bank.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace trundle {

namespace {

constexpr double kKinematic = -1.0;                    // rate that marks a kinematic drive
constexpr double kRelativeLag = 0.05, kMinLag = 0.01;  // relative and absolute speed error [rad/s or m/s] below which
                                                       // a kinematic axis takes a new speed at once
constexpr double kHuge = 1e10;
constexpr double kWakingSpeed = 1e-200;  // [rad/s or m/s] wakes a tree without moving it

int dof_of(const MotorAxis& axis) { return static_cast<int>(axis.dof); }
int actuator_of(const MotorAxis& axis) { return static_cast<int>(axis.actuator); }

}  // namespace

double MotorCommand::whole_effort() const { return effort != 0.0 ? effort + std::copysign(max_effort, effort) : 0.0; }

void wake_tree(const mjModel* m, mjData* d, int dof) {
  const bool sleeps = (m->opt.enableflags & mjENBL_SLEEP) && d->tree_asleep[m->dof_treeid[dof]] >= 0;
  if (sleeps && d->qvel[dof] == 0.0) d->qvel[dof] = kWakingSpeed;
}

MotorBank::MotorBank(mjModel* m, mjData* d, std::vector<MotorAxis> axes, std::span<MotorState> states)
    : m_(m), d_(d), axes_(std::move(axes)), states_(states) {
  LawTables laws;
  if (!LawTables::find(m, laws)) throw std::invalid_argument("this model has no laws");
  motors_ = laws.motors;
  if (static_cast<int>(states.size()) != m->nu) throw std::invalid_argument("one state for each actuator");
  for (const MotorAxis& axis : axes_)
    if (!(axis.dof >= 0.0 && axis.dof < m->nv && axis.actuator < m->nu)) throw std::invalid_argument("no such axis");
}

void MotorBank::command_effort(int axis, double effort, bool hardware) {
  const MotorAxis& moved = axis_at(axis);
  send(axis, effort_command(moved, std::min(std::max(effort, -moved.max_effort), moved.max_effort)), hardware);
}

void MotorBank::command_velocity(int axis, double velocity, double max_effort, bool hardware) {
  const double limit = std::max(std::min(std::min(max_effort, axis_at(axis).max_effort), kHuge), 0.0);
  send(axis, {velocity, limit, 0.0, 0.0}, hardware);
}

void MotorBank::command_position(int axis, double position, double max_effort, double rate) {
  const double limit = std::max(std::min(std::min(max_effort, axis_at(axis).max_effort), kHuge), 0.0);
  send(axis, {position, limit, rate, 0.0}, false);
}

void MotorBank::drive_kinematically(int axis, double velocity, bool hardware) {
  const MotorAxis& moved = axis_at(axis);
  const int actuator = actuator_of(moved);
  double& qvel = d_->qvel[dof_of(moved)];
  const double speed = qvel;
  const MotorState* last = actuator < 0 ? nullptr : &states_[static_cast<std::size_t>(actuator)];
  const double now = last && last->is_valid != 0.0 && last->rate == kKinematic ? last->target : speed;
  const double limit = std::min(moved.max_effort != 0.0 ? moved.max_effort : kHuge, kHuge);
  send(axis, {velocity, limit, kKinematic, 0.0}, hardware);
  if (velocity != now && std::abs(speed - now) <= kRelativeLag * std::abs(now) + kMinLag) qvel = velocity;
}

MotorCommand MotorBank::command_of(int axis) const {
  const MotorAxis& moved = axis_at(axis);
  const int actuator = actuator_of(moved);
  const double effort = d_->qfrc_applied[dof_of(moved)];
  if (actuator < 0) return {0.0, 0.0, 0.0, effort};
  const MotorState& state = states_[static_cast<std::size_t>(actuator)];
  if (state.is_shared != 0.0) return state.direct;
  return {d_->ctrl[actuator], m_->tendon_frictionloss[actuator], rate_of(actuator), effort};
}

MotorCommand MotorBank::effort_command(const MotorAxis& axis, double effort) const {
  if (std::isinf(axis.max_velocity) || effort == 0.0 || !std::isfinite(effort)) return {0.0, 0.0, 0.0, effort};
  // Half of the effort is constant, a motor exerts the other half: together from zero to the full effort.
  return {std::copysign(axis.max_velocity, effort), std::abs(effort) / 2.0, 0.0, effort / 2.0};
}

void MotorBank::send(int axis, MotorCommand command, bool hardware) {
  const MotorAxis& moved = axis_at(axis);
  const int dof = dof_of(moved), actuator = actuator_of(moved);
  MotorState* state = actuator < 0 ? nullptr : &states_[static_cast<std::size_t>(actuator)];
  if (state && (hardware || state->is_shared != 0.0)) command = superpose(axis, command, hardware);
  d_->qfrc_applied[dof] = command.effort;
  if (!state) return;
  // A repeated command, as controllers send in every cycle, wakes no tree.
  if (state->is_valid != 0.0 && state->target == command.target && state->max_effort == command.max_effort &&
      state->rate == command.rate)
    return;
  state->is_valid = 1.0;
  state->target = command.target;
  state->max_effort = command.max_effort;
  state->rate = command.rate;
  switches_ += (m_->tendon_frictionloss[actuator] > 0.0) != (command.max_effort > 0.0);
  m_->tendon_frictionloss[actuator] = command.max_effort;
  rate_of(actuator) = command.rate;
  d_->ctrl[actuator] = command.target;
  wake_tree(m_, d_, dof);
}

// Store a command; return the sum of the axis' direct command and its hardware interface's.
MotorCommand MotorBank::superpose(int axis, const MotorCommand& command, bool hardware) {
  const MotorAxis& moved = axis_at(axis);
  MotorState& state = states_[static_cast<std::size_t>(actuator_of(moved))];
  if (hardware) {
    state.direct = command_of(axis);
    state.interface_ = command;
    state.is_shared = 1.0;
  } else {
    state.direct = command;
  }
  const MotorCommand &direct = state.direct, &interface_ = state.interface_;
  if (interface_.rate == kKinematic || (direct.max_effort == 0.0 && direct.effort == 0.0)) return interface_;
  if (interface_.is_drive() && direct.is_drive()) return command;
  if (interface_.is_drive() || direct.is_drive()) {
    const bool of_interface = interface_.is_drive();
    const MotorCommand &drive = of_interface ? interface_ : direct, &added = of_interface ? direct : interface_;
    return {drive.target, drive.max_effort, drive.rate, below_velocity_limit(moved, added.whole_effort())};
  }
  return effort_command(moved, direct.whole_effort() + interface_.whole_effort());
}

// The effort, or 0 if it would accelerate an axis beyond its velocity limit.
double MotorBank::below_velocity_limit(const MotorAxis& axis, double effort) const {
  return std::copysign(1.0, effort) * d_->qvel[dof_of(axis)] > axis.max_velocity ? 0.0 : effort;
}

}  // namespace trundle
