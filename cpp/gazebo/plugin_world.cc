#include "plugin_world.h"

#include <algorithm>

#include "contact/midpoint.h"
#include "rotation.h"

namespace trundle {

namespace {

thread_local int inside = 0;  // depth of plugins' calls on the simulation's thread

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
