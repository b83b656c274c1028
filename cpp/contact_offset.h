// Shifts of contact margins: sliding contacts do not lift off, and SDF's min_depth.
//
// MuJoCo's convex friction cone lifts a contact that slides at v by μ times what friction would take of v, far more
// than it sinks in under its load, so it hops. SDF's min_depth is a depth up to which a contact stops bodies without
// pushing them out. Both shift the depth at which a contact begins to push.
#pragma once

#include "law_tables.h"

namespace trundle {

// Shift the margins of this step's contacts; call after mj_fwdVelocity.
void shift_contacts(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
