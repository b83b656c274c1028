#include "surface_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_geometry.h"

namespace trundle {

namespace {

// First friction direction of a track, perpendicular to the arm from the turning centre, and the belt's speed along it;
// false: none.
bool track_direction(const MotionRow& motion, const mjContact& contact, double side, double along[3], double& speed) {
  const double normal[3] = {side * contact.frame[0], side * contact.frame[1], side * contact.frame[2]};
  double backwards[3];
  cross(backwards, normal, motion.axis);
  bool is_valid = false;
  if (motion.has_centre != 0) {
    const double arm[3] = {contact.pos[0] - motion.centre[0], contact.pos[1] - motion.centre[1],
                           contact.pos[2] - motion.centre[2]};
    cross(along, normal, arm);
    is_valid = normalize(along) > 0;
  }
  if (!is_valid) {
    std::copy(backwards, backwards + 3, along);
    is_valid = normalize(along) > 0;
  }
  speed = motion.speed * dot(along, backwards);
  return is_valid;
}

void to_world(const double* axes, const double local[3], double world[3]) {
  for (int i = 0; i < 3; ++i) world[i] = dot(axes + 3 * i, local);
}

bool first_direction(const mjData* d, const MotionRow& motion, int body, const mjContact& contact, double side,
                     double along[3], double& speed) {
  const MotionKind kind = motion_kind(motion);
  if (kind == MotionKind::kTrack) return track_direction(motion, contact, side, along, speed);
  if (kind == MotionKind::kWheel) to_world(d->xmat + 9 * body, motion.axis, along);
  else std::copy(motion.axis, motion.axis + 3, along);
  speed = motion.speed;
  return true;
}

// ODE's default first friction direction (dPlaneSpace), up to its sign: along y on a level floor, horizontal on a wall.
void plane_direction(const double normal[3], double along[3]) {
  const bool level = normal[2] * normal[2] > 0.5;
  along[0] = level ? 0.0 : -normal[1];
  along[1] = level ? normal[2] : normal[0];
  along[2] = level ? -normal[1] : 0.0;
}

const MotionRow* motion_of(const LawTables& laws, int geom) {
  const MotionRow& motion = laws.motions[static_cast<std::size_t>(laws.body_of(geom))];
  return motion.kind == 0 ? nullptr : &motion;
}

}  // namespace

std::pair<const MotionRow*, int> motion_at(const LawTables& laws, const mjContact& contact) {
  if (contact.dim < 3) return {nullptr, 0};
  const MotionRow* motion = motion_of(laws, contact.geom[1]);
  return motion ? std::pair(motion, 1) : std::pair(motion_of(laws, contact.geom[0]), 0);
}

double spin_of(const mjData* d, int body, const MotionRow& motion) {
  double axis[3];
  to_world(d->xmat + 9 * body, motion.axis, axis);
  return dot(d->cvel + 6 * body, axis);
}

namespace {

// Friction of a contact that MuJoCo's collision search found: in each direction the smaller one of its geoms; false
// for a contact of a pair.
bool combine_friction(const LawTables& laws, mjContact& contact) {
  const double* frictions[2];
  for (int side = 0; side < 2; ++side)
    frictions[side] = laws.geoms[static_cast<std::size_t>(contact.geom[side])].friction;
  if (frictions[0][0] <= 0 || frictions[1][0] <= 0) return false;
  for (int t = 0; t < 2; ++t) contact.friction[t] = std::min(frictions[0][t], frictions[1][t]);
  return true;
}

}  // namespace

void align_friction(const LawTables& laws, const mjModel* m, mjData* d) {
  if (laws.friction.empty() && !laws.crowd) return;
  for (int i = 0; i < d->ncon; ++i) {
    mjContact& contact = d->contact[i];
    const FrictionRow* row = find_pair(laws.friction, pair_key(m, contact.geom));
    if (!row && (!laws.crowd || contact.dim < 3 || !combine_friction(laws, contact))) continue;
    double along[3];
    if (row && row->geom >= 0) {
      to_world(d->geom_xmat + 9 * static_cast<int>(row->geom), row->along, along);
      if (align_tangents(m, d, contact, along)) continue;
    }
    plane_direction(contact.frame, along);
    align_tangents(m, d, contact, along);
  }
}

void move_surfaces(const LawTables& laws, const mjModel* m, mjData* d) {
  if (!laws.moves) return;
  for (int i = 0; i < d->ncon; ++i) {
    mjContact& contact = d->contact[i];
    const auto [motion, second] = motion_at(laws, contact);
    if (!motion) continue;
    const double side = 2.0 * second - 1.0;  // the normal points out of the first geom
    const int body = laws.body_of(contact.geom[second]);
    double along[3], speed;
    if (!first_direction(d, *motion, body, contact, side, along, speed) || !align_tangents(m, d, contact, along))
      continue;
    contact.surfacevel[0] = side * speed;
    contact.surfacevel[1] = 0.0;
  }
}

}  // namespace trundle
