#include "velocity_motor.h"

#include <cmath>

namespace trundle {

namespace {

constexpr double kMinJump = 0.01;  // [rad/s or m/s] smaller command steps are ignored

// Call a function with each motor's constraint row.
template <typename Function>
void for_each_motor(const LawTables& laws, const mjModel* m, const mjData* d, Function&& function) {
  if (d->nf == 0) return;  // without friction constraints the arrays are not allocated
  for (int tendon = 0; tendon < m->ntendon; ++tendon)
    if (m->tendon_frictionloss[tendon] > 0.0 && d->tendon_efcadr[tendon] >= 0)
      function(d->tendon_efcadr[tendon], laws.motors[tendon]);
}

double target_speed(const MotorRow& motor, const mjData* d) {
  const double target = d->ctrl[static_cast<int>(motor.actuator)];
  return motor.rate > 0.0 ? motor.rate * (target - d->qpos[static_cast<int>(motor.qpos)]) : target;
}

// Add to a motor's effort limit in this step.
void raise_limit(mjData* d, int row, double effort) {
  d->efc_frictionloss[row] += effort;
  if (d->nisland > 0) d->iefc_frictionloss[d->map_efc2iefc[row]] += effort;
}

}  // namespace

void find_jumps(const LawTables& laws, const mjModel* m, const mjData* d, std::vector<Jump>& jumps) {
  const double h = m->opt.timestep;
  const double* last = d->userdata;
  jumps.clear();
  for_each_motor(laws, m, d, [&](int row, const MotorRow& motor) {
    const double target = target_speed(motor, d);
    if (std::abs(target - last[static_cast<int>(motor.actuator)]) < kMinJump) return;
    const int dof = static_cast<int>(motor.dof);
    jumps.push_back({dof, (target - d->qvel[dof]) / h, d->efc_frictionloss[row]});
  });
}

void drive_motors(const LawTables& laws, const mjModel* m, mjData* d) {
  const double h = m->opt.timestep;
  double* last = d->userdata;
  for (const MotorRow& motor : laws.motors)
    last[static_cast<int>(motor.actuator)] = d->qvel[static_cast<int>(motor.dof)];
  for_each_motor(laws, m, d, [&](int row, const MotorRow& motor) {
    const double target = target_speed(motor, d);
    last[static_cast<int>(motor.actuator)] = target;
    d->efc_type[row] = mjCNSTR_EQUALITY;
    d->efc_id[row] = laws.motor_equality;
    // An implicit spring of 1 and damper of 1/h have the reference acceleration -(v/h + error) / 2.
    d->efc_pos[row] = (d->efc_vel[row] - 2.0 * target) / h;
    d->efc_margin[row] = 0.0;
    const int dof = static_cast<int>(motor.dof);
    if (motor.is_kinematic()) raise_limit(d, row, std::abs(d->qfrc_bias[dof] - d->qfrc_passive[dof]));
  });
}

void report_efforts(const LawTables& laws, const mjModel* m, mjData* d) {
  for_each_motor(laws, m, d, [&](int row, const MotorRow& motor) {
    d->qfrc_actuator[static_cast<int>(motor.dof)] = d->efc_force[row];
  });
}

}  // namespace trundle
