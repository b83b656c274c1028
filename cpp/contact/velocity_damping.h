// ODE's linear and angular velocity damping: a fraction of the velocity is lost per step.
#pragma once

#include "law_tables.h"

namespace trundle {

// Add the damping forces of this step.
void apply_damping(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
