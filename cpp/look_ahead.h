// MuJoCo's looking ahead for what meets within a step, where something may go through what is thin: at every step it
// costs a furnished house a quarter of its speed, so it is on only while something moves fast enough.
#pragma once

#include "law_tables.h"

namespace trundle {

// Switch it for the next step, as long as the data is the one that the model's engine steps. Others may share the
// model; it stays on for them.
void look_ahead(const LawTables& laws, const mjModel* m, const mjData* d);

}  // namespace trundle
