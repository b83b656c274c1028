#include "velocity_motor.h"

#include <cmath>

namespace trundle {

namespace {

constexpr double kJump = 0.01;  // [rad/s or m/s] smaller changes of an order move nothing by a jerk

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

double wanted_speed(const MotorRow& motor, const mjData* d) {
  const double wanted = d->ctrl[static_cast<int>(motor.actuator)];
  return motor.rate > 0.0 ? motor.rate * (wanted - d->qpos[static_cast<int>(motor.qpos)]) : wanted;
}

// Have a motor exert so much more than its limit.
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
    const double wanted = wanted_speed(motor, d);
    if (std::abs(wanted - last[static_cast<int>(motor.actuator)]) < kJump) return;
    const int dof = static_cast<int>(motor.dof);
    jumps.push_back({dof, (wanted - d->qvel[dof]) / h, d->efc_frictionloss[row]});
  });
}

void drive_motors(const LawTables& laws, const mjModel* m, mjData* d) {
  const double h = m->opt.timestep;
  double* last = d->userdata;
  for (const MotorRow& motor : laws.motors) last[static_cast<int>(motor.actuator)] = d->qvel[static_cast<int>(motor.dof)];
  for_each_motor(laws, m, d, [&](int row, const MotorRow& motor) {
    const double wanted = wanted_speed(motor, d);
    last[static_cast<int>(motor.actuator)] = wanted;
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
