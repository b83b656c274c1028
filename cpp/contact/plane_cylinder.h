// Collision of a plane and an upright cylinder.
#pragma once

#include <mujoco/mujoco.h>

namespace trundle {

// Replace the plane-cylinder entry of MuJoCo's collision table; tilted cylinders go to the original function.
//
// The original finds the rim's lowest point from the axis's component in the plane. If that is rounding noise,
// contacts are up to a radius too deep, or missing.
void install_plane_cylinder(mjfCollision table[mjNGEOMTYPES][mjNGEOMTYPES]);

}  // namespace trundle
