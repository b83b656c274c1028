// Contacts that graze and cannot give way, as of an arm's first link, which only turns about the ground's normal.
//
// A depth that no joint can change has a force beyond all bounds, and its friction would hold the link: a rounding
// error of 1e-9 m makes kilonewtons. Such a contact stays, without force.
#pragma once

#include "mujoco_api.h"

namespace trundle {

// Take the force of grazing contacts away; return whether the constraints must be rebuilt.
bool release_grazing(const mjModel* m, mjData* d);

}  // namespace trundle
