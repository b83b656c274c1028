// Contact law tables of a compiled model, in its custom numeric fields; physics/compile/law_tables.py writes them.
//
// Constants are in mjModel and state is in mjData, so copies, threads, saved states and MuJoCo's rollouts each have
// their own.
#pragma once

#include <cstdint>
#include <span>

#include <mujoco/mujoco.h>

namespace trundle {

// Key of a pair of geoms, in either order.
inline double pair_key(const mjModel* m, const int geom[2]) {
  const std::int64_t low = geom[0] < geom[1] ? geom[0] : geom[1], high = geom[0] < geom[1] ? geom[1] : geom[0];
  return static_cast<double>(low * m->ngeom + high);
}

struct RestitutionRow {
  double pair, restitution;
  double min_speed;  // [m/s] slower approach does not bounce
};

struct FrictionRow {
  double pair;
  double geom, along[3];  // first friction direction in the frame of `geom`; geom -1: ODE's default
  double slip[3];         // [m/s/N] along and across that direction, [rad/s/(N·m)] about the normal
  double patch;           // [m²/N] (largest torque / load)² per newton of load; 0: constant
  double group;           // index of the pair of collisions; -1: no slip, constant torsional friction
};

struct DampingRow {
  double body, linear, angular;  // fraction of the velocity lost per step
};

struct ComplianceRow {
  double pair;
  double depth;    // [m] depth up to which a contact stops bodies without pushing them out
  double factor;   // ratio of the contact's stiffness to that in the model
  double rate;     // [1/s] rate at which ODE corrects a depth, by at most max_vel; 0: not capped
  double max_vel;  // [m/s]
};

struct GeomRow {
  double body;         // body of the geom's link; a static link's geoms belong to the world body
  double friction[2];  // along and across the first direction, if the geom has no pairs; 0: it has pairs
};

struct MotionRow {    // indexed by body
  double kind;        // MotionKind
  double axis[3];     // first friction direction or a track's axis in the world; a wheel's axis in the body
  double speed;       // [m/s] of the surface relative to its link
  double slip[2];     // [m/s/N] along and across the first direction; a wheel's: per rad/s of its spin
  double has_centre;  // 1: the robot of the track turns
  double centre[3];   // turning centre in the world [m]
};

struct MotorRow {    // indexed by tendon
  double actuator;   // actuator whose ctrl is the target speed or position
  double rate;       // position gain [1/s]; 0: speed motor; < 0: kinematic
  double qpos, dof;  // addresses of the joint

  // True if the motor moves its joint regardless of load; its effort then does not include gravity and inertia.
  bool is_kinematic() const { return rate < 0.0; }
};

struct ChainRow {  // chain of links
  double tree;
  double hangs;  // 1: the root of the tree is no free body
};

struct SpringRow {  // soft spring and damper of a joint
  double dof, qpos;
  double stiffness, reference;  // [N·m/rad or N/m], [rad or m]
  double damping;               // [N·m·s/rad or N·s/m] half of the damper's, by the velocity before a step; the model
                                // has the other half, by the velocity after it
};

enum class MotionKind { kNone = 0, kDirection = 1, kTrack = 2, kWheel = 3 };

inline MotionKind motion_kind(const MotionRow& motion) {
  return static_cast<MotionKind>(static_cast<int>(motion.kind));
}

struct LawTables {
  std::span<const RestitutionRow> restitution;
  std::span<const FrictionRow> friction;
  std::span<const DampingRow> damping;
  std::span<const MotionRow> motions;
  std::span<const MotorRow> motors;
  std::span<const ChainRow> chains;
  std::span<const SpringRow> springs;
  std::span<const ComplianceRow> compliance;
  std::span<const GeomRow> geoms;
  // mjData.userdata: each motor's target speed [rad/s or m/s]; each degree of freedom's VelocityTime; contact groups:
  // of bodies with a surface motion, of pairs of collisions
  int pair_groups;         // number of groups of pairs of collisions
  int motor_equality;      // equality whose solref motors use
  std::uintptr_t stepped;  // address of the mjData that the engine steps; others are evaluated
  bool crowd;              // geoms without pairs have two frictions
  double thin_speed;       // [m/s] speed above which tunnelling is possible; 0: never
  bool on;                 // all laws apply
  bool evaluates;          // friction laws apply
  bool moves;              // a row of `motions` is not kNone

  // Body of a geom's link.
  int body_of(int geom) const { return static_cast<int>(geoms[static_cast<std::size_t>(geom)].body); }

  // Read a model's tables; false: it has none.
  static bool find(const mjModel* m, LawTables& tables);
};

// Row of a pair by binary search; null: none. Rows are sorted by pair.
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
