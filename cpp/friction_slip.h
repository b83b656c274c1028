// Friction that gives way to a force, and friction against turning that grows with the load: ODE's slip1, slip2, slip3
// and surface_radius, and the slip of tyres that Gazebo's WheelSlipPlugin works out in each step.
//
// What slips has a tangential velocity of slip · force, up to the force that friction would hold. Gazebo multiplies the
// slip of a pair of collisions by the number of its contact points, so that all of them together slip as one would: a
// box on four points of ODE, a cylinder on two, and our contacts, whatever their number. Along a direction that slips,
// MuJoCo's friction is switched off, and a force of ours takes its place.
#pragma once

#include "law_tables.h"

namespace trundle {

// Find what slips in this step, and switch its friction off; return whether constraints are to be made again.
bool release_slipping(const LawTables& laws, const mjModel* m, mjData* d);

// Push against what slips in this step, once the constraints are made.
void resist_slip(const LawTables& laws, const mjModel* m, mjData* d);

// Keep how hard each group of contacts is pressed, which limits its friction in the next step [N], and have contacts that
// slip say what they resist with; once the constraints are solved.
void keep_loads(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
