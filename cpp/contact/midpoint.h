// Second-order integration (leapfrog): positions at each step, velocities half a step before.
//
// MuJoCo's step is q += h v with the new v, which is therefore the mean velocity between two positions: the midpoint's.
// Velocities that were written belong to a position instead. For a tree without contacts and commands they are moved to
// the midpoint before it, and moved back when they are read; Coriolis forces, springs and dampers act at the time of
// the position. With a velocity half a step earlier or later, each of these forces would lose or gain energy in every
// step.
#pragma once

#include "law_tables.h"

namespace trundle {

// Time of a degree of freedom's velocity; in mjData.userdata, after the motors.
enum class VelocityTime {
  kWritten = 0,   // time of the position: the velocity was written
  kMidpoint = 1,  // time midway to the position, half a step before it
  kPosition = 2,  // time of the position, after the velocity was moved half a step on, as in ODE
  kStepped = 3,   // time of the position, after the first step
};

// Move the velocities of trees that hang from fixed bodies to the midpoint before this step, after a first step, whose
// acceleration is needed; and back once a contact, motor, limit, effort or wrench acts on a tree, until its velocities
// are written again.
void update_midpoints(const LawTables& laws, const mjModel* m, mjData* d);

// Move midpoints' velocities to the time of the positions, for reading; d is not stepped afterwards.
void read_velocities(const LawTables& laws, const mjModel* m, mjData* d);

// Velocity of a degree of freedom at the time of the position.
inline double velocity_at(const mjModel* m, const mjData* d, int dof) {
  const bool is_midpoint = d->userdata[m->nu + dof] == static_cast<double>(VelocityTime::kMidpoint);
  return is_midpoint ? d->qvel[dof] + 0.5 * m->opt.timestep * d->qacc_warmstart[dof] : d->qvel[dof];
}

// Evaluate Coriolis forces of chains of links at this step's mean velocity, without those of kinematic motors.
void apply_midpoint_bias(const LawTables& laws, const mjModel* m, mjData* d);

// Add the forces of soft springs and half of soft dampers, which are not in the mjModel.
void add_springs(const LawTables& laws, mjData* d);

}  // namespace trundle
