#include "surface_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "contact_geometry.h"

namespace trundle {

namespace {

constexpr double kSmooth = 1e-5;  // friction that MuJoCo takes for none

// A contact that slips in this step.
struct Slipping {
  int contact, body;
  double slip[2];      // along the tangents [m/s/N]; 0: MuJoCo's friction holds
  double friction[2];  // along the tangents
  double speed[2];     // of the surface, along the tangents [m/s]
};

thread_local std::vector<Slipping> slipping;
thread_local std::vector<double> rows, reach, shares;  // kept from step to step

double normalize(double v[3]) {
  const double length = std::sqrt(dot(v, v));
  if (length > 0) {
    for (int i = 0; i < 3; ++i) v[i] /= length;
  }
  return length;
}

// First friction direction of a track, across the way from the point that the robot turns about, and the belt's speed
// along it; false: none.
bool track_direction(const MotionRow& motion, const mjContact& contact, double side, double along[3], double& speed) {
  const double normal[3] = {side * contact.frame[0], side * contact.frame[1], side * contact.frame[2]};
  double backwards[3];
  cross(backwards, normal, motion.axis);
  bool found = false;
  if (motion.has_centre != 0) {
    const double arm[3] = {contact.pos[0] - motion.centre[0], contact.pos[1] - motion.centre[1],
                           contact.pos[2] - motion.centre[2]};
    cross(along, normal, arm);
    found = normalize(along) > 0;
  }
  if (!found) {
    std::copy(backwards, backwards + 3, along);
    found = normalize(along) > 0;
  }
  speed = motion.speed * dot(along, backwards);
  return found;
}

bool first_direction(const MotionRow& motion, const mjContact& contact, double side, double along[3], double& speed) {
  if (static_cast<MotionKind>(static_cast<int>(motion.kind)) == MotionKind::kTrack) {
    return track_direction(motion, contact, side, along, speed);
  }
  std::copy(motion.axis, motion.axis + 3, along);
  speed = motion.speed;
  return true;
}

// What a force changes within a step [m/s/N], along both tangents: a surface that slips less is as good as one that
// holds.
void least_slips(const mjModel* m, mjData* d, const mjContact& contact, double least[2]) {
  thread_local ContactJacobian jacobian;
  rows.resize(3 * m->nv);
  reach.resize(2 * m->nv);
  jacobian.find(m, d, contact, rows.data());
  mujoco.mj_solveM(m, d, reach.data(), rows.data() + m->nv, 2);
  for (int t = 0; t < 2; ++t) {
    double moved = 0;
    for (int i = 0; i < m->nv; ++i) moved += rows[(t + 1) * m->nv + i] * reach[t * m->nv + i];
    least[t] = moved * m->opt.timestep;
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
  contact.surfacevel[0] = 0.0;
  contact.surfacevel[1] = -run;
  std::swap(contact.friction[0], contact.friction[1]);
  std::swap(each.slip[0], each.slip[1]);
}

void let_slip(const mjModel* m, mjData* d, int number, int body, const double slip[2]) {
  mjContact& contact = d->contact[number];
  double least[2];
  least_slips(m, d, contact, least);
  Slipping each{number, body, {}, {}, {}};
  for (int t = 0; t < 2; ++t) each.slip[t] = slip[t] < least[t] ? 0.0 : slip[t];
  if (each.slip[0] > 0.0 && each.slip[1] == 0.0) swap_tangents(contact, each);
  for (int t = 0; t < 2; ++t) {
    each.friction[t] = contact.friction[t];
    each.speed[t] = contact.surfacevel[t];
    if (each.slip[t] > 0.0) contact.friction[t] = kSmooth;
  }
  if (each.slip[0] > 0.0 || each.slip[1] > 0.0) slipping.push_back(each);
}

const MotionRow* motion_of(const LawTables& laws, const mjModel* m, int geom) {
  const MotionRow& motion = laws.motions[static_cast<std::size_t>(m->geom_bodyid[geom])];
  return motion.kind == 0 ? nullptr : &motion;
}

// The motion of a contact with friction, and which of its two geoms has it; null: none.
std::pair<const MotionRow*, int> motion_at(const LawTables& laws, const mjModel* m, const mjContact& contact) {
  if (contact.dim < 3) return {nullptr, 0};
  const MotionRow* motion = motion_of(laws, m, contact.geom[1]);
  return motion ? std::pair(motion, 1) : std::pair(motion_of(laws, m, contact.geom[0]), 0);
}

}  // namespace

void align_friction(const LawTables& laws, const mjModel* m, mjData* d) {
  if (laws.directions.empty()) return;
  for (int i = 0; i < d->ncon; ++i) {
    mjContact& contact = d->contact[i];
    const DirectionRow* row = find_pair(laws.directions, pair_key(m, contact.geom));
    if (!row) continue;
    const double* axes = d->geom_xmat + 9 * static_cast<int>(row->geom);
    const double along[3] = {dot(axes, row->along), dot(axes + 3, row->along), dot(axes + 6, row->along)};
    align_tangents(m, d, contact, along);
  }
}

bool move_surfaces(const LawTables& laws, const mjModel* m, mjData* d) {
  slipping.clear();
  if (!laws.moves) return false;
  for (int i = 0; i < d->ncon; ++i) {
    mjContact& contact = d->contact[i];
    const auto [motion, second] = motion_at(laws, m, contact);
    if (!motion) continue;
    const double side = 2.0 * second - 1.0;  // the normal points out of the first
    double along[3], speed;
    if (!first_direction(*motion, contact, side, along, speed) || !align_tangents(m, d, contact, along)) continue;
    contact.surfacevel[0] = side * speed;
    contact.surfacevel[1] = 0.0;
    if (motion->slip[0] > 0 || motion->slip[1] > 0) {
      let_slip(m, d, i, m->geom_bodyid[contact.geom[second]], motion->slip);
    }
  }
  return !slipping.empty();
}

void resist_slip(const LawTables& laws, const mjModel* m, mjData* d) {
  if (slipping.empty()) return;
  const double* loads = d->userdata;
  shares.assign(m->nbody, 0.0);
  for (const Slipping& each : slipping) shares[each.body] += 1.0;
  thread_local ContactJacobian jacobian;
  for (const Slipping& each : slipping) {
    rows.resize(3 * m->nv);
    jacobian.find(m, d, d->contact[each.contact], rows.data());
    double force[2], share[2];
    for (int t = 0; t < 2; ++t) {
      double speed = each.speed[t];
      for (int i = 0; i < m->nv; ++i) speed += rows[(t + 1) * m->nv + i] * d->qvel[i];
      force[t] = each.slip[t] > 0 ? -speed / (shares[each.body] * each.slip[t]) : 0.0;
      share[t] = force[t] / std::max(each.friction[t] * loads[each.body] / shares[each.body], 1e-12);
    }
    const double over = std::max(std::sqrt(share[0] * share[0] + share[1] * share[1]), 1.0);
    for (int t = 0; t < 2; ++t) {
      for (int i = 0; i < m->nv; ++i) d->qfrc_passive[i] += force[t] / over * rows[(t + 1) * m->nv + i];
    }
  }
}

void weigh_surfaces(const LawTables& laws, const mjModel* m, mjData* d) {
  if (!laws.moves) return;
  double* loads = d->userdata;
  std::fill(loads, loads + m->nbody, 0.0);
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    const auto [motion, second] = motion_at(laws, m, contact);
    if (motion && contact.efc_address >= 0) {
      loads[m->geom_bodyid[contact.geom[second]]] += d->efc_force[contact.efc_address];
    }
  }
}

}  // namespace trundle
