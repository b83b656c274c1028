// mj_step that throws MuJoCo's errors: outside MuJoCo's Python binding they would end the process.
#pragma once

#include "mujoco_api.h"

namespace trundle {

// Throws std::runtime_error with MuJoCo's message.
void guarded_step(const mjModel* m, mjData* d);

}  // namespace trundle
