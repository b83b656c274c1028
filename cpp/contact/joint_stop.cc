#include "joint_stop.h"

namespace trundle {

namespace {

constexpr double kBeyond =
    1e-9;  // [rad or m] distance past the limit, so that MuJoCo's constraint of the limit holds from then on

}  // namespace

void approach_stops(const mjModel* m, mjData* d) {
  const double h = m->opt.timestep;
  for (int row = d->ne + d->nf; row < d->ne + d->nf + d->nl; ++row) {
    if (d->efc_type[row] != mjCNSTR_LIMIT_JOINT || !(d->efc_margin[row] > 0)) continue;
    d->efc_margin[row] = 0;
    double& distance = d->efc_pos[row];
    if (distance < 0) continue;
    const int joint = d->efc_id[row];
    const double *solref = m->jnt_solref + 2 * joint, impedance = m->jnt_solimp[5 * joint + 1];
    // A row of stiffness k and damping b has the reference acceleration -(b v + k position) / (1 + h b + h² k); set
    // it so that the joint moves just beyond the limit.
    const double k = -solref[0] / impedance, b = -solref[1] / impedance;
    const double acceleration = -((distance + kBeyond) / h + d->efc_vel[row]) / h;
    distance = -(acceleration * (1 + h * b + h * h * k) + b * d->efc_vel[row]) / k;
  }
}

}  // namespace trundle
