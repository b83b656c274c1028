// Force-dependent slip and load-dependent torsional friction: ODE's slip1, slip2, slip3 and surface_radius, and the
// tyre slip of Gazebo's WheelSlipPlugin.
//
// A slipping contact has a tangential velocity of slip · force, up to Coulomb's limit. Gazebo multiplies the slip of a
// pair of collisions by its number of contact points, so that the pair slips as with a single point. The same holds
// here. Along a slipping direction MuJoCo's friction is switched off and replaced by an applied force.
#pragma once

#include "law_tables.h"

namespace trundle {

// Find slipping contacts and switch their friction off; return whether the constraints must be rebuilt.
bool release_slipping(const LawTables& laws, const mjModel* m, mjData* d);

// Apply the forces of slipping contacts; call once the constraints are built.
void resist_slip(const LawTables& laws, const mjModel* m, mjData* d);

// Record the normal load [N] of each group of contacts that slip together, which limits its friction in the next step,
// and report the forces of slipping contacts; call once the constraints are solved.
void record_loads(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
