// mj_step outside MuJoCo's Python binding, which alone makes exceptions of MuJoCo's errors: else they end the process.
#pragma once

#include "mujoco_api.h"

namespace trundle {

// Throws std::runtime_error with MuJoCo's message.
void guarded_step(const mjModel* m, mjData* d);

}  // namespace trundle
