// Second-order integration (leapfrog) of Coriolis forces and springs.
//
// MuJoCo's velocities are those of the midpoint between two steps: q += h v. Coriolis forces at the old velocity and
// springs at the new position lose or gain energy in every step; at the mean velocity and the position between, they
// conserve it.
#pragma once

#include "law_tables.h"

namespace trundle {

// Evaluate Coriolis forces of chains of links at this step's mean velocity, without those of kinematic motors.
void apply_midpoint_bias(const LawTables& laws, const mjModel* m, mjData* d);

// Add the forces of soft springs, which are not in the mjModel.
void apply_springs(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
