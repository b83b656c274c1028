#include "grazing.h"

#include <vector>

#include "contact_geometry.h"

namespace trundle {

namespace {

constexpr double kGrazing = 1e-5;  // depth up to which a contact may be one of rounding [m]
constexpr double kStuck =
    1e-6;  // ratio of the motion along the normal to that along all axes below which there is none

// True if a body's tree moves freely, and gives way everywhere.
bool moves_freely(const mjModel* m, int geom) {
  const int root = m->body_rootid[m->geom_bodyid[geom]];
  return m->body_jntnum[root] > 0 && m->jnt_type[m->body_jntadr[root]] == mjJNT_FREE;
}

bool gives_way(const mjModel* m, const mjData* d, const mjContact& contact) {
  thread_local ContactJacobian jacobian;
  thread_local std::vector<double> rows;
  rows.resize(3 * m->nv);
  jacobian.find(m, d, contact, rows.data());
  double along = 0.0, all = 0.0;
  for (int i = 0; i < 3 * m->nv; ++i) {
    const double square = rows[i] * rows[i];
    if (i < m->nv) along += square;
    all += square;
  }
  return along > kStuck * kStuck * all;
}

}  // namespace

bool release_grazing(const mjModel* m, mjData* d) {
  bool any = false;
  for (int i = 0; i < d->ncon; ++i) {
    mjContact& contact = d->contact[i];
    if (contact.exclude != 0 || contact.dist < -kGrazing || contact.geom[0] < 0 || contact.geom[1] < 0) continue;
    if (moves_freely(m, contact.geom[0]) || moves_freely(m, contact.geom[1]) || gives_way(m, d, contact)) continue;
    contact.dim = 1;
    contact.solref[0] = contact.solref[1] = -mjMINVAL;
    any = true;
  }
  return any;
}

}  // namespace trundle
