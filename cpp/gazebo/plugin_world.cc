#include "plugin_world.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "contact/midpoint.h"

namespace trundle {

namespace {

thread_local int inside = 0;  // depth of plugins' calls on the simulation's thread

void rotate(const double* q, const double* v, bool inverse, double* out) {
  const double w = inverse ? -q[0] : q[0], x = q[1], y = q[2], z = q[3];
  const double tx = 2 * (y * v[2] - z * v[1]), ty = 2 * (z * v[0] - x * v[2]), tz = 2 * (x * v[1] - y * v[0]);
  out[0] = v[0] + w * tx + y * tz - z * ty;
  out[1] = v[1] + w * ty + z * tx - x * tz;
  out[2] = v[2] + w * tz + x * ty - y * tx;
}

bool are_finite(const double* values, int count) {
  return std::all_of(values, values + count, [](double value) { return std::isfinite(value); });
}

constexpr double kUnreachable = -1e6;                   // [m]
constexpr int kCounts[] = {6, 7, 6, 1, 1, 1, 2, 1, 1};  // numbers of each command

}  // namespace

bool PluginWorld::is_inside() const { return inside > 0; }
void PluginWorld::enter_call() {
  ++inside;
  has_poses_ = has_twists_ = false;
}
void PluginWorld::leave_call() {
  has_poses_ = has_twists_ = false;
  copy_values();
  --inside;
}
void PluginWorld::begin_call() {
  ++inside;
  has_poses_ = has_twists_ = false;
}
void PluginWorld::end_call() { --inside; }

void PluginWorld::bind(mjModel* m, mjData* d, std::shared_ptr<MotorBank> bank,
                       const std::vector<std::pair<std::string, int>>& links, const std::vector<BoundJoint>& joints,
                       std::vector<std::string> collisions) {
  const std::scoped_lock lock(names_mutex_, copies_mutex_);
  if (m != m_) {
    pair_margins_.clear();
    if (rest_) rest_.emplace();
  }
  m_ = m;
  d_ = d;
  bank_ = std::move(bank);
  collisions_ = std::move(collisions);
  for (Link& link : links_) link.body = -1;
  for (Joint& joint : joints_) joint.exists = false;
  for (const auto& [name, body] : links) {
    const auto [at, is_new] = link_numbers_.try_emplace(name, static_cast<int>(links_.size()));
    if (is_new) links_.emplace_back();
    links_[static_cast<std::size_t>(at->second)].body = body;
  }
  for (Link& link : links_) link.collides |= link.body < 0;
  geom_links_.clear();
  for (const std::string& collision : collisions_) {
    const auto found = link_numbers_.find(collision.substr(0, collision.rfind("::")));
    geom_links_.push_back(found == link_numbers_.end() ? -1 : found->second);
  }
  apply_collides();
  for (const BoundJoint& bound : joints) {
    const auto [at, is_new] = joint_numbers_.try_emplace(bound.name, static_cast<int>(joints_.size()));
    if (is_new) joints_.emplace_back();
    Joint& joint = joints_[static_cast<std::size_t>(at->second)];
    joint.exists = true;
    joint.axes.resize(bound.axes.size());
    for (std::size_t i = 0; i < bound.axes.size(); ++i) joint.axes[i].bound = bound.axes[i];
    joint.body = bound.link < 0 ? -1 : links[static_cast<std::size_t>(bound.link)].second;
    joint.anchor = bound.anchor;
    joint.sign = bound.sign;
  }
  qvel_.resize(static_cast<std::size_t>(m->nv));
  copied_links_.resize(links_.size());
  copied_joints_.resize(joints_.size());
  copied_wrenches_.resize(joints_.size());
  has_poses_ = has_twists_ = false;
}

int PluginWorld::find(int kind, const std::string& name) const {
  const std::lock_guard lock(names_mutex_);
  const auto& numbers = kind == TRUNDLE_LINK ? link_numbers_ : joint_numbers_;
  const auto found = numbers.find(name);
  return found == numbers.end() ? -1 : found->second;
}

void PluginWorld::begin(std::int64_t time_ns, std::int64_t step_ns) {
  ++inside;
  time_ns_ = time_ns;
  step_ns_ = step_ns;
  ++acts_;
  is_acting_ = true;
  has_poses_ = has_twists_ = false;
  restore_rest();
  if (wants_wrenches_) update_wrenches();
  if (has_waiting_.exchange(false)) {
    std::vector<Write> waiting;
    {
      const std::lock_guard lock(queue_mutex_);
      waiting.swap(waiting_);
    }
    for (const Write& write : waiting) write_now(write);
  }
}

void PluginWorld::end() {
  for (const int number : touched_links_) apply_wrench(links_[static_cast<std::size_t>(number)]);
  std::erase_if(touched_links_, [this](int number) { return !links_[static_cast<std::size_t>(number)].is_applied; });
  for (const auto& [number, axis] : touched_axes_)
    if (Axis* touched = axis_of(number, axis)) apply_efforts(*touched);
  std::erase_if(touched_axes_, [this](const auto& touched) {
    const Axis* axis = axis_of(touched.first, touched.second);
    return !axis || (axis->mode != Mode::kSpeed && axis->last_effort == 0.0);
  });
  if (rest_) keep_rest();
  if (wants_copies_) copy_values();
  is_acting_ = false;
  --inside;
}

void PluginWorld::clear_commands() {
  restore_collides();
  for (Link& link : links_) link.pending = {}, link.is_applied = false;
  for (Joint& joint : joints_)
    for (Axis& axis : joint.axes) axis.mode = Mode::kNone, axis.effort = axis.last_effort = 0.0;
  touched_links_.clear();
  touched_axes_.clear();
  if (rest_) rest_.emplace();
}

void PluginWorld::update_poses() {
  if (has_poses_) return;
  kinematics_.positions(m_, d_);
  has_poses_ = true;
}

void PluginWorld::update_twists() {
  if (has_twists_) return;
  update_poses();
  kinematics_.centers(m_, d_);
  std::copy_n(d_->qvel, m_->nv, qvel_.data());
  for (int dof = 0; dof < m_->nv; ++dof) d_->qvel[dof] = velocity_at(m_, d_, dof);
  kinematics_.velocities(m_, d_);
  std::copy_n(qvel_.data(), m_->nv, d_->qvel);
  has_twists_ = true;
}

// Of the last step, whose velocities and accelerations the data have until something moves. Joints of trees that sleep
// keep theirs: nothing is known about what they stand on.
void PluginWorld::update_wrenches() {
  kinematics_.forces(m_, d_);
  for (Joint& joint : joints_) {
    if (!joint.exists || joint.body < 0) continue;
    const int body = joint.body, tree = m_->body_treeid[body];
    if (tree >= 0 && d_->tree_asleep[tree] >= 0) continue;
    // MuJoCo's torque is about the centre of mass of the whole tree.
    const double *c = d_->cfrc_int + 6 * body, *com = d_->subtree_com + 3 * m_->body_rootid[body];
    double arm[3];
    rotate(d_->xquat + 4 * body, joint.anchor.data(), false, arm);
    for (int i = 0; i < 3; ++i) arm[i] = com[i] - d_->xpos[3 * body + i] - arm[i];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      joint.wrench[i] = joint.sign * c[3 + i];
      joint.wrench[3 + i] = joint.sign * (c[i] + arm[j] * c[3 + k] - arm[k] * c[3 + j]);
    }
  }
}

int PluginWorld::free_joint(int body) const {
  const int joint = m_->body_jntadr[body];
  return joint >= 0 && m_->jnt_type[joint] == mjJNT_FREE ? joint : -1;
}

PluginWorld::Axis* PluginWorld::axis_of(int number, int axis) {
  if (number < 0 || number >= static_cast<int>(joints_.size())) return nullptr;
  Joint& joint = joints_[static_cast<std::size_t>(number)];
  if (!joint.exists || axis < 0 || axis >= static_cast<int>(joint.axes.size())) return nullptr;
  return &joint.axes[static_cast<std::size_t>(axis)];
}

int PluginWorld::read(int value, int number, int axis, double* out, int capacity) {
  double values[7];
  int count = 0;
  if (value == TRUNDLE_JOINT_WRENCH && !wants_wrenches_.exchange(true) && is_inside()) update_wrenches();
  if (is_inside()) {
    count = read_now(value, number, axis, values);
  } else {
    wants_copies_ = true;
    const std::lock_guard lock(copies_mutex_);
    const auto index = static_cast<std::size_t>(number);
    const bool is_link = value == TRUNDLE_LINK_POSE || value == TRUNDLE_LINK_TWIST;
    if (value == TRUNDLE_GRAVITY) {
      std::copy_n(copied_gravity_.data(), count = 3, values);
    } else if (number < 0) {
      return 0;
    } else if (value == TRUNDLE_JOINT_WRENCH && index < copied_wrenches_.size()) {
      std::copy_n(copied_wrenches_[index].data(), count = 6, values);
    } else if (is_link && index < copied_links_.size()) {
      const bool is_pose = value == TRUNDLE_LINK_POSE;
      std::copy_n(copied_links_[index].data() + (is_pose ? 0 : 7), count = is_pose ? 7 : 6, values);
    } else if (value == TRUNDLE_LINK_IS_FREE && index < links_.size() && links_[index].body >= 0) {
      values[0] = free_joint(links_[index].body) >= 0;
      count = 1;
    } else if (index < copied_joints_.size() && value >= TRUNDLE_JOINT_POSITION && value <= TRUNDLE_JOINT_AXES) {
      const auto& axes = copied_joints_[index];
      if (value == TRUNDLE_JOINT_AXES) values[0] = static_cast<double>(axes.size()), count = 1;
      else if (axis >= 0 && static_cast<std::size_t>(axis) < axes.size())
        values[0] = axes[static_cast<std::size_t>(axis)][static_cast<std::size_t>(value - TRUNDLE_JOINT_POSITION)],
        count = 1;
    }
  }
  std::copy_n(values, std::min(count, capacity), out);
  return std::min(count, capacity);
}

int PluginWorld::read_now(int value, int number, int axis, double* out) {
  if (value == TRUNDLE_GRAVITY) return std::copy_n(m_->opt.gravity, 3, out), 3;
  if (value <= TRUNDLE_LINK_IS_FREE) {
    if (number < 0 || number >= static_cast<int>(links_.size())) return 0;
    const int body = links_[static_cast<std::size_t>(number)].body;
    if (body < 0) return 0;
    if (value == TRUNDLE_LINK_IS_FREE) return out[0] = free_joint(body) >= 0, 1;
    if (value == TRUNDLE_LINK_POSE) {
      update_poses();
      std::copy_n(d_->xpos + 3 * body, 3, out);
      std::copy_n(d_->xquat + 4 * body, 4, out + 3);
      return 7;
    }
    update_twists();
    const double *c = d_->cvel + 6 * body, *p = d_->xpos + 3 * body;
    const double* com = d_->subtree_com + 3 * m_->body_rootid[body];
    const double x = p[0] - com[0], y = p[1] - com[1], z = p[2] - com[2];
    out[0] = c[3] + c[1] * z - c[2] * y;
    out[1] = c[4] + c[2] * x - c[0] * z;
    out[2] = c[5] + c[0] * y - c[1] * x;
    std::copy_n(c, 3, out + 3);
    return 6;
  }
  if (value == TRUNDLE_JOINT_AXES) {
    if (number < 0 || number >= static_cast<int>(joints_.size())) return 0;
    const Joint& joint = joints_[static_cast<std::size_t>(number)];
    return joint.exists ? (out[0] = static_cast<double>(joint.axes.size()), 1) : 0;
  }
  if (value == TRUNDLE_JOINT_WRENCH) {
    if (number < 0 || number >= static_cast<int>(joints_.size())) return 0;
    const Joint& joint = joints_[static_cast<std::size_t>(number)];
    return joint.exists && joint.body >= 0 ? (std::copy_n(joint.wrench.data(), 6, out), 6) : 0;
  }
  const Axis* at = axis_of(number, axis);
  if (!at) return 0;
  const BoundAxis& bound = at->bound;
  switch (value) {
    case TRUNDLE_JOINT_POSITION: out[0] = bound.is_driven ? d_->qpos[bound.qpos] * bound.sign : 0.0; return 1;
    case TRUNDLE_JOINT_VELOCITY: out[0] = velocity_at(m_, d_, bound.dof) * bound.sign; return 1;
    case TRUNDLE_JOINT_EFFORT:
      out[0] = (d_->qfrc_applied[bound.dof] + d_->qfrc_actuator[bound.dof]) * bound.sign;
      return 1;
    default: return 0;
  }
}

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

void PluginWorld::copy_values() {
  const std::lock_guard lock(copies_mutex_);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    read_now(TRUNDLE_LINK_POSE, static_cast<int>(i), 0, copied_links_[i].data());
    read_now(TRUNDLE_LINK_TWIST, static_cast<int>(i), 0, copied_links_[i].data() + 7);
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    copied_wrenches_[i] = joints_[i].wrench;
    copied_joints_[i].resize(joints_[i].exists ? joints_[i].axes.size() : 0);
    for (std::size_t axis = 0; axis < copied_joints_[i].size(); ++axis)
      for (int value = TRUNDLE_JOINT_POSITION; value <= TRUNDLE_JOINT_EFFORT; ++value)
        read_now(value, static_cast<int>(i), static_cast<int>(axis),
                 &copied_joints_[i][axis][static_cast<std::size_t>(value - TRUNDLE_JOINT_POSITION)]);
  }
  std::copy_n(m_->opt.gravity, 3, copied_gravity_.data());
}

int PluginWorld::contacts(TrundleGazeboContact* out, int capacity) const {
  if (!is_inside()) return 0;
  int count = 0;
  for (int i = 0; i < d_->ncon; ++i) {
    const mjContact& contact = d_->contact[i];
    if (contact.efc_address < 0 || contact.geom[0] < 0 || contact.geom[1] < 0) continue;
    if (count < capacity) {
      mjtNum local[6];
      kinematics_.contact_force(m_, d_, i, local);
      TrundleGazeboContact& written = out[count];
      written.collision1 = collisions_[static_cast<std::size_t>(contact.geom[0])].c_str();
      written.collision2 = collisions_[static_cast<std::size_t>(contact.geom[1])].c_str();
      written.depth = std::max(-contact.dist, 0.0);
      for (int k = 0; k < 3; ++k) {
        written.position[k] = contact.pos[k];
        written.normal[k] = -contact.frame[k];
        written.force[k] =
            -(contact.frame[k] * local[0] + contact.frame[3 + k] * local[1] + contact.frame[6 + k] * local[2]);
      }
    }
    ++count;
  }
  return count;
}

void PluginWorld::request(PluginRequest request) {
  const std::lock_guard lock(queue_mutex_);
  requests_.push_back(std::move(request));
  has_queued_ = true;
}

void PluginWorld::warn(const std::string& text) {
  const std::lock_guard lock(queue_mutex_);
  warnings_.push_back(text);
  has_queued_ = true;
}

bool PluginWorld::needs_python() { return has_queued_; }

std::vector<PluginRequest> PluginWorld::take_requests() {
  const std::lock_guard lock(queue_mutex_);
  has_queued_ = !warnings_.empty();
  return std::exchange(requests_, {});
}

std::vector<std::string> PluginWorld::take_warnings() {
  const std::lock_guard lock(queue_mutex_);
  has_queued_ = !requests_.empty();
  return std::exchange(warnings_, {});
}

}  // namespace trundle
