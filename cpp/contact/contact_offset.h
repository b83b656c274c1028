// Shifts of contact margins: sliding contacts do not lift off; SDF's min_depth, max_vel, kp and kd.
//
// MuJoCo's convex friction cone lifts a contact that slides at v by μ times what friction would take of v, far more
// than it sinks in under its load, so it hops. SDF's min_depth is a depth up to which a contact stops bodies without
// pushing them out. MuJoCo's springs act on the depth at the end of the step, which damps; a spring with little damping
// acts on a multiple of the depth instead. ODE's cap on depth correction stops recoil, and bodies rest deeper than
// their springs alone would have it: such a spring has ODE's damping and a softer law of depth. All shift the depth at
// which a contact begins to push.
#pragma once

#include "law_tables.h"

namespace trundle {

// Set the margins of contacts with a min_depth, or with a stiffer spring than the model has.
void apply_compliance(const LawTables& laws, const mjModel* m, mjData* d);

// Keep sliding contacts down in this step; call after mj_fwdVelocity and `apply_compliance`.
void hold_sliding(const LawTables& laws, const mjModel* m, mjData* d);

// Rate at which friction that suffices reduces the slip of a contact [1/s].
double slip_decay(const mjContact& contact, double h);

}  // namespace trundle
