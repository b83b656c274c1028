#include "velocity_motor.h"

#include <cmath>

namespace trundle {

namespace {

// Have a function called with each row of friction that is a motor's, and the motor.
template <typename Function>
void for_each_motor(const LawTables& laws, const mjModel* m, const mjData* d, Function&& function) {
  if (d->nf == 0) return;  // without constraints their arrays are not there
  for (int tendon = 0; tendon < m->ntendon; ++tendon) {
    if (m->tendon_frictionloss[tendon] > 0.0 && d->tendon_efcadr[tendon] >= 0) {
      function(d->tendon_efcadr[tendon], laws.motors[tendon]);
    }
  }
}

// Have a motor exert so much more than its limit.
void raise_limit(mjData* d, int row, double effort) {
  d->efc_frictionloss[row] += effort;
  if (d->nisland > 0) d->iefc_frictionloss[d->map_efc2iefc[row]] += effort;
}

}  // namespace

void drive_motors(const LawTables& laws, const mjModel* m, mjData* d) {
  const double h = m->opt.timestep;
  for_each_motor(laws, m, d, [&](int row, const MotorRow& motor) {
    double wanted = d->ctrl[static_cast<int>(motor.actuator)];
    if (motor.rate > 0.0) wanted = motor.rate * (wanted - d->qpos[static_cast<int>(motor.qpos)]);
    d->efc_type[row] = mjCNSTR_EQUALITY;
    d->efc_id[row] = laws.motor_equality;
    // A spring of 1 and a damper of 1/h, taken at the step's end, want the acceleration -(v/h + error) / 2.
    d->efc_pos[row] = (d->efc_vel[row] - 2.0 * wanted) / h;
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
