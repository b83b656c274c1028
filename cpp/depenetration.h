// What begins inside something else comes out no faster than its surface's max_vel.
//
// ODE limits the speed at which it corrects depth. MuJoCo's contacts have no such limit: what begins 10 cm deep would be
// shot out at 6 m/s. So contacts of what began deep are made to look no deeper than what comes out at that speed.
#pragma once

#include "law_tables.h"

namespace trundle {

// Mark the geoms that are deeper in something than they may come out of at once.
void mark_deep(const LawTables& laws, const mjModel* m, mjData* d);

// Have contacts of marked geoms look shallower before they are solved; return whether any did. Marks of geoms that are
// out go away.
bool limit_depth(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
