#include "plain_metric.h"

#include <algorithm>
#include <vector>

namespace trundle {

namespace {

bool is_zero(double value) { return value == 0.0; }

// True if dampers, springs, tendons or a fluid contribute to the metric; our actuators have no gains and do not.
bool has_terms(const mjModel* m, const mjData* d) {
  if (d->efm_active != 1 || d->nefmT > 0) return true;
  if (m->opt.density != 0.0 || m->opt.viscosity != 0.0) return true;
  return d->efm_diag && !std::all_of(d->efm_diag, d->efm_diag + m->nv, is_zero);
}

// Trees in contact, one flag each.
const std::vector<char>& find_touching(const mjModel* m, const mjData* d) {
  thread_local std::vector<char> touching;
  touching.assign(m->ntree, 0);
  for (int i = 0; i < d->ncon; ++i) {
    if (d->contact[i].efc_address < 0) continue;
    for (const int geom : d->contact[i].geom) {
      const int tree = m->body_treeid[m->geom_bodyid[geom]];
      if (tree >= 0) touching[tree] = 1;
    }
  }
  return touching;
}

// True if a free body can have gyroscopic torques: its inertia is not spherical about its origin.
bool has_gyroscopic_torque(const mjModel* m, int body) {
  const double* inertia = m->body_inertia + 3 * body;
  const double* centre = m->body_ipos + 3 * body;
  const bool is_round = inertia[0] == inertia[1] && inertia[1] == inertia[2];
  return !is_round || !std::all_of(centre, centre + 3, is_zero);
}

// True if gyroscopic forces of some body are in the metric, where MuJoCo integrates them implicitly. It does so only
// for free bodies that are alone in their tree and not in contact.
bool has_implicit_gyroscopic_body(const mjModel* m, const mjData* d) {
  const std::vector<char>& touching = find_touching(m, d);
  for (int joint = 0; joint < m->njnt; ++joint) {
    if (m->jnt_type[joint] != mjJNT_FREE) continue;
    const int body = m->jnt_bodyid[joint], tree = m->body_treeid[body];
    const bool moves = d->tree_asleep[tree] < 0;
    if (m->tree_dofnum[tree] == 6 && moves && !touching[tree] && has_gyroscopic_torque(m, body)) return true;
  }
  return false;
}

}  // namespace

void use_plain_metric(const mjModel* m, mjData* d) {
  if (m->opt.integrator != mjINT_DISCRETE || has_terms(m, d) || has_implicit_gyroscopic_body(m, d)) return;
  d->efm_active = 0;
  // MuJoCo does not update efm_sdiag while the metric is off, and its solver would add the stale values.
  d->efm_diag = d->efm_sdiag = nullptr;
}

}  // namespace trundle
