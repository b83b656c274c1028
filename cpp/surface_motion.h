// Surfaces that have friction directions of their own, run under a contact, or give way to a force.
//
// ODE has fdir1, motion1, slip1 and slip2 for them. A moving surface is a number that MuJoCo's contacts have a place for.
// Along a direction in which a surface slips, MuJoCo's friction is switched off, and a force that grows with the speed
// takes its place, up to what friction would hold.
#pragma once

#include "law_tables.h"

namespace trundle {

// Lay the first tangents of contacts along the directions of their pairs.
void align_friction(const LawTables& laws, const mjModel* m, mjData* d);

// Lay the first tangents of contacts along the motion of their surfaces; return whether constraints are to be made again,
// for some friction is another.
bool move_surfaces(const LawTables& laws, const mjModel* m, mjData* d);

// Push against what slips in this step, once the constraints are made: force = -speed / slip, within the ellipse of
// friction.
void resist_slip(const LawTables& laws, const mjModel* m, mjData* d);

// Keep how hard each body with a surface that moves is pressed, which limits its friction in the next step [N]; once the
// constraints are solved.
void weigh_surfaces(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
