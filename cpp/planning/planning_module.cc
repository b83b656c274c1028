// The Python module `_planning`: kinematics, collisions and planners of arms. None holds the GIL.
#include <nanobind/nanobind.h>

#include "kinematics_bindings.h"
#include "scene_bindings.h"

NB_MODULE(_planning, module) {
  trundle::planning::bind_kinematics(module);
  trundle::planning::bind_scene(module);
  trundle::planning::bind_planners(module);
  trundle::planning::bind_trajectories(module);
}
