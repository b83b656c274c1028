// Velocity motors with an effort limit, as ODE's joint motors.
//
// A MuJoCo tendon with friction loss is such a constraint, for speed 0. Its reference is computed after mjcb_control
// from the row's constraint type: declared an equality with a chosen position error, it drives to any speed. It stays
// bounded because the solver identifies friction rows by their index.
#pragma once

#include <vector>

#include "law_tables.h"

namespace trundle {

// Motor whose command stepped since the previous step.
struct Jump {
  int dof;
  double acceleration;  // acceleration that reaches the target within this step [rad/s² or m/s²]
  double effort;        // effort limit [N·m or N]
};

void find_jumps(const LawTables& laws, const mjModel* m, const mjData* d, std::vector<Jump>& jumps);

// Set the constraint rows of motors to the targets in ctrl.
void drive_motors(const LawTables& laws, const mjModel* m, mjData* d);

// Write the motors' efforts to qfrc_actuator after a step.
void report_efforts(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
