// Functions of the MuJoCo that Python has loaded, found by name at run time: its library is never linked, for its name
// changes with every release and Windows has no import library of it.
#pragma once

#include <mujoco/mujoco.h>

namespace trundle {

#define TRUNDLE_MUJOCO_FUNCTIONS(X)                                                                              \
  X(mj_applyFT) X(mj_comVel) X(mj_fwdVelocity) X(mj_island) X(mj_isSparse) X(mj_jac) X(mj_makeConstraint)            \
  X(mj_mulJacVec) X(mj_objectVelocity) X(mj_projectConstraint) X(mj_rne)           \
  X(mj_solveM)


struct MujocoApi {
#define TRUNDLE_FIELD(name) decltype(&::name) name = nullptr;
  TRUNDLE_MUJOCO_FUNCTIONS(TRUNDLE_FIELD)
#undef TRUNDLE_FIELD
  mjfGeneric* control = nullptr;  // where mjcb_control is
  mjfSensor* sensor = nullptr;    // and mjcb_sensor
  mjfTime* time = nullptr;        // and mjcb_time
};

extern MujocoApi mujoco;

}  // namespace trundle
