// What a compiled model says of its contact laws: tables in its custom numbers, which physics/law_tables.py writes.
//
// They lie in mjModel, and what changes from step to step in mjData, so that copies of both, threads, saved states and
// MuJoCo's own batches of simulations each have theirs.
#pragma once

#include <cstdint>
#include <span>

#include <mujoco/mujoco.h>

namespace trundle {

// A pair of geoms as one number; the smaller first.
inline double pair_key(const mjModel* m, const int geom[2]) {
  const std::int64_t low = geom[0] < geom[1] ? geom[0] : geom[1], high = geom[0] < geom[1] ? geom[1] : geom[0];
  return static_cast<double>(low * m->ngeom + high);
}

struct RestitutionRow {
  double pair, restitution;
  double slowest;  // [m/s] what approaches slower, does not bounce
};

struct FrictionRow {
  double pair;
  double geom, along[3];  // first friction direction in that geom's frame; -1: ODE's own
  double slip[3];         // [m/s/N] along it and across it, [rad/s/(N·m)] about the normal
  double patch;           // [m²/N] (largest torque / load)² for each newton of load; 0: that ratio is the pair's own
  double group;           // its two collisions' number; -1: nothing of it slips or grows
};

struct DampingRow {
  double body, linear, angular;  // parts of a velocity that one step takes away
};

struct DeadZoneRow {
  double pair, depth;  // [m] up to which a contact holds and does not push
};

struct GeomRow {
  double body;  // of its link: what stands may be a shape of the world's body
};

struct MotionRow {  // of the body of the same number
  double kind;           // MotionKind
  double axis[3];        // world: first friction direction, or the axis that a track's belt turns about; body: a wheel's
  double speed;          // [m/s] of the surface past its link
  double slip[2];        // [m/s/N] along the first direction and across it; a wheel's: for each rad/s that it turns
  double has_centre;     // a track's robot turns
  double centre[3];      // about this point of the world [m]
};

struct MotorRow {  // of the tendon of the same number
  double actuator;   // whose ctrl is the speed to keep, or the position to hold
  double rate;       // [1/s] at which it closes in on the position; 0: it keeps a speed; below: kinematically
  double qpos, dof;  // of its joint

  // Nothing feels that what it drives is moved, and its own weight is none of its effort.
  bool is_kinematic() const { return rate < 0.0; }
};

struct ChainRow {  // links that hang from one another
  double tree;
};

struct SpringRow {
  double dof, qpos;
  double stiffness, reference;  // [N·m/rad or N/m], [rad or m]
};

enum class MotionKind { kNone = 0, kDirection = 1, kTrack = 2, kWheel = 3 };

inline MotionKind motion_kind(const MotionRow& motion) { return static_cast<MotionKind>(static_cast<int>(motion.kind)); }

struct LawTables {
  std::span<const RestitutionRow> restitution;
  std::span<const FrictionRow> friction;
  std::span<const DampingRow> damping;
  std::span<const MotionRow> motions;
  std::span<const MotorRow> motors;
  std::span<const ChainRow> chains;
  std::span<const SpringRow> springs;
  std::span<const DeadZoneRow> dead_zones;
  std::span<const GeomRow> geoms;
  // userdata: the speed that each motor wants [rad/s or m/s], then how contacts push in groups: those of each body with a
  // motion, then those of two collisions
  int pair_groups;  // how many there are of the latter
  int motor_equality;  // whose spring and damper motors' constraints have
  std::uintptr_t stepped;  // the data that an engine steps with this model, which it has for itself
  double thin_speed;       // [m/s] from which on something may go through what is thin; 0: nothing may
  bool on;     // contact laws act
  bool evaluates;  // those of friction alone
  bool moves;  // some row of motions is of a kind

  // The body of the link that a geom is of.
  int body_of(int geom) const { return static_cast<int>(geoms[static_cast<std::size_t>(geom)].body); }

  // Those of a model; false: it has none.
  static bool find(const mjModel* m, LawTables& found);
};

// The row of a contact's pair; null: none. Rows are in order of their pairs.
template <typename Row>
const Row* find_pair(std::span<const Row> rows, double pair) {
  std::size_t first = 0, last = rows.size();
  while (first < last) {
    const std::size_t middle = (first + last) / 2;
    if (rows[middle].pair < pair) first = middle + 1;
    else last = middle;
  }
  return first < rows.size() && rows[first].pair == pair ? &rows[first] : nullptr;
}

}  // namespace trundle
