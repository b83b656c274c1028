// Friction directions and moving surfaces: ODE's fdir1 and motion1. mjContact has a field for the surface velocity.
#pragma once

#include <utility>

#include "law_tables.h"

namespace trundle {

// Turn first tangents to the friction directions of their pairs.
void align_friction(const LawTables& laws, const mjModel* m, mjData* d);

// Turn first tangents to the motion of moving surfaces, and set its speed.
void move_surfaces(const LawTables& laws, const mjModel* m, mjData* d);

// Surface motion at a contact with friction, and which of its two geoms has it; null: none.
std::pair<const MotionRow*, int> motion_at(const LawTables& laws, const mjContact& contact);

// Angular velocity of a wheel about its axis [rad/s].
double spin_of(const mjData* d, int body, const MotionRow& motion);

}  // namespace trundle
