// Surfaces that have friction directions of their own, or run under a contact.
//
// ODE has fdir1 and motion1 for them. A moving surface is a number that MuJoCo's contacts have a place for.
#pragma once

#include <utility>

#include "law_tables.h"

namespace trundle {

// Lay the first tangents of contacts along the directions of their pairs.
void align_friction(const LawTables& laws, const mjModel* m, mjData* d);

// Lay the first tangents of contacts along the motion of their surfaces.
void move_surfaces(const LawTables& laws, const mjModel* m, mjData* d);

// The motion of a contact with friction, and which of its two geoms has it; null: none.
std::pair<const MotionRow*, int> motion_at(const LawTables& laws, const mjContact& contact);

// How fast a body with a wheel's motion turns about the wheel's axis [rad/s].
double spin_of(const mjData* d, int body, const MotionRow& motion);

}  // namespace trundle
