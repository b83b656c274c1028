// Kinematics in the Python module `_planning`.
#pragma once

#include <nanobind/nanobind.h>

namespace trundle::planning {

void bind_kinematics(nanobind::module_& module);

}  // namespace trundle::planning
