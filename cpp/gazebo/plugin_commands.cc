// What plugins command: poses, twists, wrenches, efforts and speeds, whether links collide, and whether physics act.
#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "contact/midpoint.h"
#include "plugin_world.h"
#include "rotation.h"

namespace trundle {

namespace {

constexpr double kUnreachable = -1e6;                   // [m]
constexpr int kCounts[] = {6, 7, 6, 1, 1, 1, 2, 1, 1};  // numbers of each command

bool are_finite(const double* values, int count) {
  return std::all_of(values, values + count, [](double value) { return std::isfinite(value); });
}

}  // namespace

bool PluginWorld::write(int command, int number, int axis, const double* values, int count) {
  if (command < 0 || command > TRUNDLE_SET_PHYSICS || count < kCounts[command] || number < 0) return false;
  if (!are_finite(values, kCounts[command])) return false;
  Write write{command, number, axis, {}, kCounts[command]};
  std::copy_n(values, write.count, write.values.data());
  if (is_inside()) return write_now(write);
  const std::lock_guard lock(queue_mutex_);
  waiting_.push_back(write);
  has_waiting_ = true;
  return true;
}

bool PluginWorld::write_now(const Write& write) {
  if (write.command == TRUNDLE_SET_PHYSICS) return write_physics(write.values[0] != 0.0);
  if (write.command <= TRUNDLE_SET_COLLIDE) {
    if (write.number >= static_cast<int>(links_.size())) return false;
    Link& link = links_[static_cast<std::size_t>(write.number)];
    return link.body >= 0 && write_link(link, write);
  }
  Axis* axis = axis_of(write.number, write.axis);
  return axis && write_axis(*axis, write);
}

// Write the velocities of a degree of freedom's tree at the time of its positions, before they change.
void PluginWorld::synchronize(int dof) {
  const int tree = m_->dof_treeid[dof], first = m_->tree_dofadr[tree];
  for (int other = first; other < first + m_->tree_dofnum[tree]; ++other) {
    d_->qvel[other] = velocity_at(m_, d_, other);
    d_->userdata[m_->nu + other] = static_cast<double>(VelocityTime::kWritten);
  }
}

void PluginWorld::moved(int dof) {
  wake_tree(m_, d_, dof);
  has_poses_ = has_twists_ = false;
  has_changed_ = true;
}

bool PluginWorld::write_physics(bool is_on) {
  if (is_on) rest_.reset();
  else if (!rest_) rest_.emplace();
  return true;
}

// The engine steps as always, so that time and sensors go on; afterwards everything is where it was.
void PluginWorld::keep_rest() {
  const double* times = d_->userdata + m_->nu;
  rest_ = Rest{{d_->qpos, d_->qpos + m_->nq}, {d_->qvel, d_->qvel + m_->nv}, {times, times + m_->nv}, true};
}

void PluginWorld::restore_rest() {
  if (!rest_ || !std::exchange(rest_->has_stepped, false)) return;
  std::copy(rest_->qpos.begin(), rest_->qpos.end(), d_->qpos);
  std::copy(rest_->qvel.begin(), rest_->qvel.end(), d_->qvel);
  std::copy(rest_->times.begin(), rest_->times.end(), d_->userdata + m_->nu);
  has_poses_ = has_twists_ = false;
  has_changed_ = has_moved_ = true;
}

bool PluginWorld::write_link(Link& link, const Write& write) {
  if (write.command == TRUNDLE_ADD_WRENCH) {
    if (std::all_of(link.pending.begin(), link.pending.end(), [](double v) { return v == 0.0; }) && !link.is_applied)
      touched_links_.push_back(write.number);
    for (std::size_t i = 0; i < 6; ++i) link.pending[i] += write.values[i];
    return true;
  }
  if (write.command == TRUNDLE_SET_COLLIDE) {
    link.collides = write.values[0] != 0.0;
    apply_collides();
    if (m_->body_dofnum[link.body] > 0) moved(m_->body_dofadr[link.body]);
    return true;
  }
  const int joint = free_joint(link.body);
  if (joint < 0) return false;
  double *q = d_->qpos + m_->jnt_qposadr[joint], *v = d_->qvel + m_->jnt_dofadr[joint];
  const int dof = m_->jnt_dofadr[joint];
  synchronize(dof);
  if (write.command == TRUNDLE_SET_TWIST) {
    std::copy_n(write.values.data(), 3, v);
    rotate(q + 3, write.values.data() + 3, true, v + 3);
  } else {
    double spin[3];
    rotate(q + 3, v + 3, false, spin);
    std::copy_n(write.values.data(), 7, q);
    const double length = std::sqrt(q[3] * q[3] + q[4] * q[4] + q[5] * q[5] + q[6] * q[6]);
    for (int i = 3; i < 7; ++i) q[i] = length > 0.0 ? q[i] / length : i == 3;
    rotate(q + 3, spin, true, v + 3);
    has_moved_ = true;
  }
  moved(dof);
  return true;
}

// Pairs of geoms that may touch are listed in the model; with a margin that no distance reaches they do not.
void PluginWorld::apply_collides() {
  const auto collides = [this](int geom) {
    const int number = geom < 0 ? -1 : geom_links_[static_cast<std::size_t>(geom)];
    return number < 0 || links_[static_cast<std::size_t>(number)].collides;
  };
  for (int pair = 0; m_ && pair < m_->npair; ++pair) {
    const bool touches = collides(m_->pair_geom1[pair]) && collides(m_->pair_geom2[pair]);
    if (touches && !pair_margins_.contains(pair)) continue;
    const mjtNum margin = pair_margins_.try_emplace(pair, m_->pair_margin[pair]).first->second;
    m_->pair_margin[pair] = touches ? margin : kUnreachable;
  }
}

void PluginWorld::restore_collides() {
  for (Link& link : links_) link.collides = true;
  apply_collides();
}

bool PluginWorld::write_axis(Axis& axis, const Write& write) {
  const BoundAxis& bound = axis.bound;
  if (!bound.is_driven && write.command != TRUNDLE_ADD_EFFORT) return false;
  if (axis.mode != Mode::kSpeed && axis.effort == 0.0 && axis.last_effort == 0.0)
    touched_axes_.emplace_back(write.number, write.axis);
  switch (write.command) {
    case TRUNDLE_SET_POSITION:
      synchronize(bound.dof);
      d_->qpos[bound.qpos] = write.values[0] * bound.sign;
      moved(bound.dof);
      break;
    case TRUNDLE_SET_SPEED:
      axis.mode = Mode::kSpeed;
      axis.stamp = is_acting_ ? acts_ : acts_ + 1;
      bank_->drive_kinematically(bound.index, write.values[0], false);
      has_twists_ = false;
      break;
    case TRUNDLE_DRIVE:
      axis.mode = write.values[1] > 0.0 ? Mode::kDrive : Mode::kNone;
      bank_->command_velocity(bound.index, write.values[0], write.values[1], false);
      break;
    default: axis.effort += write.values[0]; break;
  }
  return true;
}

// Add a link's forces to those that others apply, for one step.
void PluginWorld::apply_wrench(Link& link) {
  if (link.body < 0) {
    link.is_applied = false;
    return;
  }
  double* applied = d_->xfrc_applied + 6 * link.body;
  if (!link.is_applied || !std::equal(applied, applied + 6, link.written.begin()))
    std::copy_n(applied, 6, link.base.data());
  link.is_applied = std::any_of(link.pending.begin(), link.pending.end(), [](double v) { return v != 0.0; });
  for (std::size_t i = 0; i < 6; ++i) applied[i] = link.written[i] = link.base[i] + link.pending[i];
  link.pending = {};
}

// Apply an axis' effort for one step, and release one whose speed was set in the last step alone.
void PluginWorld::apply_efforts(Axis& axis) {
  const bool is_released = axis.mode == Mode::kSpeed && axis.stamp != acts_;
  if (is_released) axis.mode = Mode::kNone;
  if (is_released || axis.effort != 0.0 || axis.last_effort != 0.0) {
    if (axis.mode == Mode::kNone) bank_->command_effort(axis.bound.index, axis.effort, false);
    else d_->qfrc_applied[axis.bound.dof] = axis.effort;
  }
  axis.last_effort = axis.effort;
  axis.effort = 0.0;
}

}  // namespace trundle
