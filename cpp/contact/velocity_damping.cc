#include "velocity_damping.h"

#include <cmath>

#include "contact_geometry.h"

namespace trundle {

namespace {

constexpr double kMinSpeed = 0.01;  // [m/s or rad/s] ODE's threshold

}  // namespace

void apply_damping(const LawTables& laws, const mjModel* m, mjData* d) {
  const double h = m->opt.timestep;
  for (const DampingRow& row : laws.damping) {
    const int body = static_cast<int>(row.body);
    if (body == 0) continue;  // the world body has the geoms of static links
    double velocity[6];       // velocity of the centre of mass, in world axes: angular first
    mujoco.mj_objectVelocity(m, d, mjOBJ_BODY, body, velocity, 0);
    const double *spin = velocity, *speed = velocity + 3, *axes = d->ximat + 9 * body;
    double force[3] = {0, 0, 0}, torque[3] = {0, 0, 0};
    if (std::sqrt(dot(speed, speed)) > kMinSpeed)
      for (int i = 0; i < 3; ++i) force[i] = -row.linear * m->body_mass[body] / h * speed[i];
    if (std::sqrt(dot(spin, spin)) > kMinSpeed) {
      for (int axis = 0; axis < 3; ++axis) {  // principal axes, the columns of ximat
        const double about = axes[axis] * spin[0] + axes[3 + axis] * spin[1] + axes[6 + axis] * spin[2];
        const double max_torque = -row.angular / h * m->body_inertia[3 * body + axis] * about;
        for (int i = 0; i < 3; ++i) torque[i] += axes[3 * i + axis] * max_torque;
      }
    }
    mujoco.mj_applyFT(m, d, force, torque, d->xipos + 3 * body, body, d->qfrc_passive);
  }
}

}  // namespace trundle
