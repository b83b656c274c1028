#include "contact_offset.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mujoco_api.h"

namespace trundle {

namespace {

constexpr double kSlowest = 1e-6;  // [m/s] what slides slower does not lift by anything that counts

struct Spring {
  double stiffness, damping;  // [1/s², 1/s] of a row, by MuJoCo's rules for solref
};

Spring spring(const mjtNum* solref, double impedance) {
  const double d = impedance;
  if (solref[0] > 0) {
    const double time = d * solref[0], decay = time * solref[1];
    return {1 / std::max(decay * decay, mjMINVAL), 2 / std::max(time, mjMINVAL)};
  }
  return {-solref[0] / (d * d), -solref[1] / d};
}

// How far a contact's sliding would lift it [m]; accelerations are those of the step before, one for each row.
//
// A row's force is (reference − acceleration) / R. While a contact slides, its friction rows are off by what is
// left of their reference, and the dual of the cone puts the normal row off by μ times that.
double lift(const mjContact& contact, const mjData* d, double h, const double* accelerations) {
  const double impedance = contact.solimp[1];
  const bool own = contact.solreffriction[0] != 0 || contact.solreffriction[1] != 0;
  const Spring normal = spring(contact.solref, impedance);
  const double damping = spring(own ? contact.solreffriction : contact.solref, impedance).damping;
  const double stiffness = normal.stiffness * impedance;
  double sum = 0;
  for (int j = 1; j < contact.dim; ++j) {
    const int row = contact.efc_address + j;
    const double left = contact.friction[j - 1] * (accelerations[row] + damping * d->efc_vel[row] / (1 + h * damping));
    sum += left * left;
  }
  // The normal spring is that at the step's end, which divides its reference by the same sum as R.
  const double whole = 1 + h * normal.damping + h * h * stiffness;
  // What hits is held by friction that was not there the step before, as strong as what stops it.
  const double most = std::max(contact.friction[0], contact.friction[1]);
  const double impact = std::max(-d->efc_vel[contact.efc_address], 0.0) * normal.damping / whole;
  return std::max(std::sqrt(sum) - most * most * impact, 0.0) * whole / stiffness;
}

bool slides(const mjContact& contact, const mjData* d) {
  double sum = 0;
  for (int j = 1; j < contact.dim; ++j) {
    const double speed = d->efc_vel[contact.efc_address + j];
    sum += speed * speed;
  }
  return sum > kSlowest * kSlowest;
}

}  // namespace

void shift_contacts(const LawTables& laws, const mjModel* m, mjData* d) {
  if (m->opt.integrator != mjINT_DISCRETE || m->opt.cone != mjCONE_ELLIPTIC) return;
  thread_local std::vector<double> accelerations;
  bool known = false;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0) continue;
    double& margin = d->efc_margin[contact.efc_address];
    if (!laws.dead_zones.empty()) {
      const DeadZoneRow* zone = find_pair(laws.dead_zones, pair_key(m, contact.geom));
      if (zone) margin = std::max(contact.dist, -zone->depth);
    }
    if (contact.dim < 3 || !slides(contact, d)) continue;
    if (!known) {
      accelerations.resize(d->nefc);
      mujoco.mj_mulJacVec(m, d, accelerations.data(), d->qacc_warmstart);
      known = true;
    }
    margin -= lift(contact, d, m->opt.timestep, accelerations.data());
  }
}

}  // namespace trundle
