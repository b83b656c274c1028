// Second-order integration (leapfrog) of Coriolis forces and springs.
//
// MuJoCo's velocities are those of the midpoint between two steps: q += h v. Coriolis forces at the old velocity and
// springs at the new position lose or gain energy in every step; at the mean velocity and the position between, they
// conserve it.
#pragma once

#include "law_tables.h"

namespace trundle {

// Move new velocities of chains with ball joints, which are of the start of this step, to the midpoint before it.
//
// mjData.userdata holds 1 for each degree of freedom whose velocity is a midpoint's. A step then reaches the midpoint
// of the next two, and positions are exact to second order.
void start_at_midpoint(const LawTables& laws, const mjModel* m, mjData* d);

// Evaluate Coriolis forces of chains of links at this step's mean velocity, without those of kinematic motors.
void apply_midpoint_bias(const LawTables& laws, const mjModel* m, mjData* d);

// Add the forces of soft springs, which are not in the mjModel, to those of the degrees of freedom.
void add_springs(const LawTables& laws, const mjData* d, double* forces);

}  // namespace trundle
