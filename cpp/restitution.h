// Restitution: the bounce that a spring and a damper cannot make.
//
// MuJoCo's contacts push with forces over several steps, and how high a body comes back then depends on the phase of the
// impact. So a contact that bounces gets an impulse at the moment it is found: the speeds of approach turn round by
// Newton's law, friction within Coulomb's cone, over all contacts at once by projected Gauss-Seidel.
#pragma once

#include "law_tables.h"

namespace trundle {

// Give the impulses of this step; return whether there were any.
bool apply_restitution(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
