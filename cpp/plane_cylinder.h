// Where a cylinder that stands upright touches a plane.
#pragma once

#include <mujoco/mujoco.h>

namespace trundle {

// Have MuJoCo's table of collision functions hold ours for planes and cylinders, which calls the one that was there.
//
// MuJoCo's own looks for the rim's lowest point by the part of the axis that lies in the plane. Where that is no more
// than rounding, so is what it finds: a contact up to a radius too deep, or none at all.
void install_plane_cylinder(mjfCollision table[mjNGEOMTYPES][mjNGEOMTYPES]);

}  // namespace trundle
