#include "friction_slip.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "contact_geometry.h"
#include "surface_motion.h"

namespace trundle {

namespace {

constexpr double kSmooth = 1e-5;  // friction that MuJoCo takes for none
constexpr double kFirm = 0.1;     // part of what a force changes in a step: a surface that slips less, holds
constexpr int kRows = 4;          // along the normal, along two tangents, about the normal

// A contact that slips in this step: along two tangents, and about the normal.
struct Slipping {
  int contact, group;
  double side;         // 1: forces of the group are on the second body; -1: on the first
  double slip[3];      // [m/s/N], [rad/s/(N·m)]; 0: MuJoCo's friction holds
  double change[3];    // what a force changes within a step, in the same units
  double friction[3];  // [-], [-], [m]
  double speed[3];     // of the surface [m/s]
  double force[3];     // that resists [N], [N], [N·m]
};

// Contacts that slip as one: their load, and the force and torque about the normal of the last step.
struct Group {
  double load, force[3], torque;
};

// What the tables say of a contact.
struct SlipOf {
  double slip[3];
  double patch;  // see FrictionRow
  int group;
  double side;
};

thread_local std::vector<Slipping> slipping;
thread_local const mjData* slipping_in = nullptr;
thread_local std::vector<double> rows, moved, shares;  // kept from step to step

Group* groups(const mjModel* m, mjData* d) { return reinterpret_cast<Group*>(d->userdata + m->nu); }

// How much a contact slips by the motion of one of its bodies.
bool add_motion(const LawTables& laws, const mjModel* m, const mjData* d, const mjContact& contact, SlipOf& found) {
  const auto [motion, second] = motion_at(laws, contact);
  if (!motion || (motion->slip[0] <= 0 && motion->slip[1] <= 0)) return false;
  found.group = laws.body_of(contact.geom[second]);
  found.side = 2.0 * second - 1.0;
  const double scale = motion_kind(*motion) == MotionKind::kWheel ? std::abs(spin_of(d, found.group, *motion)) : 1.0;
  for (int t = 0; t < 2; ++t) found.slip[t] += motion->slip[t] * scale;
  return true;
}

bool find_slip(const LawTables& laws, const mjModel* m, const mjData* d, const mjContact& contact, SlipOf& found) {
  found = {};
  if (contact.dim < 3 || contact.exclude != 0) return false;
  bool slips = false;
  if (laws.pair_groups > 0) {
    const FrictionRow* row = find_pair(laws.friction, pair_key(m, contact.geom));
    if (row && row->group >= 0) {
      std::copy(row->slip, row->slip + 3, found.slip);
      found.patch = row->patch;
      found.group = m->nbody + static_cast<int>(row->group);
      found.side = 1.0;
      slips = true;
    }
  }
  if (laws.moves) slips |= add_motion(laws, m, d, contact, found);
  return slips;
}

// What a force changes within a step, along the tangents and about the normal: the contact's rows are there.
void find_changes(const mjModel* m, mjData* d, double change[3]) {
  const int nv = m->nv;
  moved.resize(3 * nv);
  mujoco.mj_solveM(m, d, moved.data(), rows.data() + nv, 3);
  for (int t = 0; t < 3; ++t) {
    double sum = 0;
    for (int i = 0; i < nv; ++i) sum += rows[(t + 1) * nv + i] * moved[t * nv + i];
    change[t] = sum * m->opt.timestep;
  }
}

// Swap the tangents: the solver wants the direction that holds to be the first.
void swap_tangents(mjContact& contact, Slipping& each) {
  double* frame = contact.frame;
  for (int i = 0; i < 3; ++i) {
    const double first = frame[3 + i];
    frame[3 + i] = frame[6 + i];
    frame[6 + i] = -first;
  }
  const double run = contact.surfacevel[0];
  contact.surfacevel[0] = contact.surfacevel[1];
  contact.surfacevel[1] = -run;
  std::swap(contact.friction[0], contact.friction[1]);
  std::swap(each.slip[0], each.slip[1]);
  std::swap(each.change[0], each.change[1]);
}

// Let a contact slip; false: all of it holds.
bool release(const mjModel* m, mjData* d, Slipping& each) {
  thread_local ContactJacobian jacobian;
  mjContact& contact = d->contact[each.contact];
  rows.resize(kRows * m->nv);
  jacobian.find(m, d, contact, rows.data(), kRows);
  find_changes(m, d, each.change);
  for (int t = 0; t < 3; ++t) {
    if (each.slip[t] < kFirm * each.change[t] || t + 2 > contact.dim) each.slip[t] = 0.0;
  }
  if (each.slip[0] > 0.0 && each.slip[1] == 0.0) swap_tangents(contact, each);
  bool any = false;
  for (int t = 0; t < 3; ++t) {
    each.friction[t] = contact.friction[t];
    each.speed[t] = t < 2 ? contact.surfacevel[t] : 0.0;
    if (each.slip[t] > 0.0) {
      contact.friction[t] = kSmooth;
      any = true;
    }
  }
  return any;
}

// ODE's torque grows with the patch of contact, whose radius is the square root of its depth and curvature: what is
// pressed by N on a stiffness kp is N / kp deep.
void size_patch(mjContact& contact, double patch, double load) {
  contact.friction[2] = std::max(std::sqrt(patch * load), kSmooth);
}

// Force of a contact along one of its directions: that which leaves it at slip · force in the end, whatever else pushes.
//
// -speed / slip alone is unstable where it slips less than a force changes within a step; in the force that the last
// step had, that which else pushes is known.
double force_along(const Slipping& each, int t, double share, double speed, double last) {
  return (each.change[t] * last - speed) / (share * (each.slip[t] + each.change[t]));
}

void push(const mjModel* m, mjData* d, Slipping& each, Group& group, const Group& last, double share) {
  thread_local ContactJacobian jacobian;
  const int nv = m->nv;
  const mjContact& contact = d->contact[each.contact];
  rows.resize(kRows * nv);
  jacobian.find(m, d, contact, rows.data(), kRows);
  double over[3];
  double* force = each.force;
  for (int t = 0; t < 3; ++t) {
    double speed = each.speed[t];
    for (int i = 0; i < nv; ++i) speed += rows[(t + 1) * nv + i] * d->qvel[i];
    const double before = t < 2 ? dot(contact.frame + 3 * (t + 1), last.force) : last.torque;
    force[t] = each.slip[t] > 0 ? force_along(each, t, share, speed, each.side * before) : 0.0;
    over[t] = force[t] / std::max(each.friction[t] * last.load / share, 1e-12);
  }
  const double sliding = std::max(std::sqrt(over[0] * over[0] + over[1] * over[1]), 1.0);
  const double turning = std::max(std::abs(over[2]), 1.0);
  for (int t = 0; t < 3; ++t) {
    force[t] /= t < 2 ? sliding : turning;
    for (int i = 0; i < nv; ++i) d->qfrc_passive[i] += force[t] * rows[(t + 1) * nv + i];
  }
  for (int i = 0; i < 3; ++i) {
    group.force[i] += each.side * (force[0] * contact.frame[3 + i] + force[1] * contact.frame[6 + i]);
  }
  group.torque += each.side * force[2];
}

// Have contacts say what they resist with: who asks for their forces reads those of the solver's rows.
void show_slipping(mjData* d) {
  if (slipping_in != d) return;
  for (const Slipping& each : slipping) {
    if (each.contact >= d->ncon) return;
    const int first = d->contact[each.contact].efc_address;
    for (int t = 0; first >= 0 && t < 3; ++t) {
      if (each.slip[t] > 0.0) d->efc_force[first + 1 + t] = each.force[t];
    }
  }
  slipping_in = nullptr;
}

}  // namespace

bool release_slipping(const LawTables& laws, const mjModel* m, mjData* d) {
  slipping.clear();
  slipping_in = d;
  if (!laws.moves && laws.pair_groups == 0) return false;
  shares.assign(static_cast<std::size_t>(m->nbody + laws.pair_groups), 0.0);
  SlipOf found;
  for (int i = 0; i < d->ncon; ++i) {
    if (find_slip(laws, m, d, d->contact[i], found)) shares[found.group] += 1.0;
  }
  bool changed = false;
  for (int i = 0; i < d->ncon; ++i) {
    if (!find_slip(laws, m, d, d->contact[i], found)) continue;
    if (found.patch > 0) {
      size_patch(d->contact[i], found.patch, groups(m, d)[found.group].load / shares[found.group]);
      changed = true;
    }
    Slipping each{i, found.group, found.side, {found.slip[0], found.slip[1], found.slip[2]}, {}, {}, {}, {}};
    if (*std::max_element(each.slip, each.slip + 3) > 0.0 && release(m, d, each)) slipping.push_back(each);
  }
  return changed || !slipping.empty();
}

void resist_slip(const LawTables& laws, const mjModel* m, mjData* d) {
  if (!laws.moves && laws.pair_groups == 0) return;
  Group* kept = groups(m, d);
  thread_local std::vector<Group> last;
  last.assign(kept, kept + m->nbody + laws.pair_groups);
  for (std::size_t i = 0; i < last.size(); ++i) kept[i] = {last[i].load, {}, {}};
  for (Slipping& each : slipping) {
    push(m, d, each, kept[each.group], last[each.group], shares[each.group]);
  }
}

void keep_loads(const LawTables& laws, const mjModel* m, mjData* d) {
  if (!laws.moves && laws.pair_groups == 0) return;
  Group* kept = groups(m, d);
  for (int i = 0; i < m->nbody + laws.pair_groups; ++i) kept[i].load = 0.0;
  SlipOf found;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address >= 0 && find_slip(laws, m, d, contact, found)) {
      kept[found.group].load += d->efc_force[contact.efc_address];
    }
  }
  show_slipping(d);
}

}  // namespace trundle
