// Joint stops that are reached at the end of a step, not passed within it.
//
// MuJoCo has no force at a limit before it is passed, so a joint overshoots by up to a step's motion. Models with laws
// have a margin at each limit (physics/compile/law_tables.py), within which there is a constraint; here it lets the
// joint move up to the limit.
#pragma once

#include "mujoco_api.h"

namespace trundle {

// Set the constraint rows of limits.
void approach_stops(const mjModel* m, mjData* d);

}  // namespace trundle
