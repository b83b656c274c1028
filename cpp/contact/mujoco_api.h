// Functions of the MuJoCo library that Python has loaded, bound at run time: it is not linked, because its file name
// changes with every release and Windows has no import library for it.
#pragma once

#include <mujoco/mujoco.h>

// Returns the previous handler of this thread's messages; exported for MuJoCo's Python binding, in no header.
extern "C" mjfLogHandler _mjPRIVATE_setTlsLogHandler(mjfLogHandler handler);

namespace trundle {

// clang-format off
#define TRUNDLE_MUJOCO_FUNCTIONS(X)                                                               \
  X(_mjPRIVATE_setTlsLogHandler) X(mj_applyFT) X(mj_comPos) X(mj_comVel) X(mj_contactForce)       \
  X(mj_fwdVelocity) X(mj_getState) X(mj_integratePos) X(mj_isSparse) X(mj_island) X(mj_jac)       \
  X(mj_kinematics) X(mj_makeConstraint) X(mj_mulJacVec) X(mj_objectVelocity)                      \
  X(mj_projectConstraint) X(mj_rne) X(mj_setState) X(mj_solveM) X(mj_stateSize) X(mj_step)
// clang-format on

struct MujocoApi {
#define TRUNDLE_FIELD(name) decltype(&::name) name = nullptr;
  TRUNDLE_MUJOCO_FUNCTIONS(TRUNDLE_FIELD)
#undef TRUNDLE_FIELD
  mjfGeneric* control = nullptr;  // address of mjcb_control
  mjfSensor* sensor = nullptr;    // address of mjcb_sensor
  mjfTime* time = nullptr;        // address of mjcb_time
};

extern MujocoApi mujoco;

}  // namespace trundle
