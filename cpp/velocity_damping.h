// Velocities that lose a part of themselves at every step, as by ODE's linear and angular damping.
#pragma once

#include "law_tables.h"

namespace trundle {

// Add the forces that take the part away within this step.
void apply_damping(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
