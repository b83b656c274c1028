// What slides stays on what it slides over, and contacts that hold before they push back.
//
// MuJoCo's convex cone makes a contact that slides at v lift off by μ times what its friction would take of v, far more
// than it sinks in by its load: it hops. And SDF's min_depth lets a contact stop what comes without pushing it out. Both
// are shifts of the depth at which a contact begins to push.
#pragma once

#include "law_tables.h"

namespace trundle {

// Shift the margins of this step's contacts, once their speeds are known.
void shift_contacts(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
