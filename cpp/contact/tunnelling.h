// Continuous collision detection (MuJoCo's speculative contacts) against tunnelling through thin shapes. At every step
// it would cost a furnished house a quarter of its speed, so it is on only while a body moves fast enough.
#pragma once

#include "law_tables.h"

namespace trundle {

// Switch collision detection for the next step, if this is the mjData that the engine steps. It stays continuous for
// other users of the model.
void update_ccd(const LawTables& laws, const mjModel* m, const mjData* d);

}  // namespace trundle
