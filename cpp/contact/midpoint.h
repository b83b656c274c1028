// Second-order integration (leapfrog): positions at each step, velocities half a step before.
//
// MuJoCo's step is q += h v with the new v, which so is the mean velocity between two positions, that of the midpoint.
// Velocities that are given belong to a position instead. Where a tree moves by itself they are moved to the midpoint
// before it, and moved back when they are read; Coriolis forces, springs and dampers act at the time of the position.
// By the velocity of half a step ago or ahead each would lose or gain energy in every step.
#pragma once

#include "law_tables.h"

namespace trundle {

// What a degree of freedom's velocity is that of; in mjData.userdata, behind the motors.
enum class VelocityTime {
  kGiven = 0,     // the position's: it is new
  kMidpoint = 1,  // the midpoint before the position
  kPosition = 2,  // the position's, which is half a step ahead, as ODE has it
  kStepped = 3,   // the position's, after its first step
};

// Move the velocities of trees that hang from something fixed to the midpoint before this step, after a first step,
// whose acceleration that takes; and back once a contact, motor, limit, effort or wrench acts on a tree, until its
// velocities are given again.
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

// Add the forces of soft springs, which are not in the mjModel, and the half of soft dampers that is not.
void add_springs(const LawTables& laws, mjData* d);

}  // namespace trundle
