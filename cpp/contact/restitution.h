// Restitution by impulses.
//
// MuJoCo's soft contacts act over several steps, and the rebound then depends on the impact's phase within a step. So a
// bouncing contact gets an impulse when it is found: normal velocities by Newton's law of restitution, friction within
// Coulomb's cone or ODE's pyramid, all contacts together by projected Gauss-Seidel.
#pragma once

#include "law_tables.h"

namespace trundle {

// Apply this step's impulses; return whether there were any.
bool apply_restitution(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
