// What makes MuJoCo's step one of second order for chains of links and springs.
//
// MuJoCo's speeds are those of the middle between two steps: q += h v. Forces of Coriolis and springs that are taken at
// the old speed, or at the position after the step, lose or gain energy at every step. Taken at the middle of the speeds
// before and after, and at the position between, they keep it (the leapfrog).
#pragma once

#include "law_tables.h"

namespace trundle {

// Take the Coriolis forces of chains of links at the middle of this step's speeds. The speeds of kinematic motors have
// none.
void center_bias(const LawTables& laws, const mjModel* m, mjData* d);

// Add the forces of springs soft enough for that, which MuJoCo is not told of.
void apply_springs(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
