// Motors that keep a speed with a force up to a limit, as ODE's joint motors.
//
// MuJoCo's friction in a tendon of one joint is such a constraint, for the speed 0. Its reference is worked out after
// mjcb_control, by the kind of constraint that a row says it is: as one of an equality, which has a position error, it
// wants whatever speed that error is chosen for, and is bounded still, for the solver tells friction by the row's place.
#pragma once

#include <vector>

#include "law_tables.h"

namespace trundle {

// A motor whose order is another than in the step before, and changes its speed by more than what may be held.
struct Jump {
  int dof;
  double acceleration;  // that takes it there within this step [rad/s² or m/s²]
  double effort;        // up to which the motor goes [N·m or N]
};

void find_jumps(const LawTables& laws, const mjModel* m, const mjData* d, std::vector<Jump>& jumps);

// Have the rows of motors want the speeds that ctrl says.
void drive_motors(const LawTables& laws, const mjModel* m, mjData* d);

// Write what motors exert to qfrc_actuator, which nothing else does, after a step.
void report_efforts(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
