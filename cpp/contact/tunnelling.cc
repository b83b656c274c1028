#include "tunnelling.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "contact_geometry.h"

namespace trundle {

namespace {

double length(const double v[3]) { return std::sqrt(dot(v, v)); }

// Upper bound of the speed of any point of a body's shapes [m/s].
double fastest_point(const mjModel* m, const mjData* d, int body) {
  const double* spin = d->cvel + 6 * body;  // velocity of the tree's centre of mass: angular, linear
  const double* centre = d->subtree_com + 3 * m->body_rootid[body];
  const double* at = d->xipos + 3 * body;
  const double arm[3] = {at[0] - centre[0], at[1] - centre[1], at[2] - centre[2]};
  double velocity[3];
  cross(velocity, spin, arm);
  for (int i = 0; i < 3; ++i) velocity[i] += spin[3 + i];
  double reach = 0;
  for (int i = 0; i < m->body_geomnum[body]; ++i) {
    const int geom = m->body_geomadr[body] + i;
    const double *from = m->body_ipos + 3 * body, *to = m->geom_pos + 3 * geom;
    const double away = std::abs(to[0] - from[0]) + std::abs(to[1] - from[1]) + std::abs(to[2] - from[2]);
    reach = std::max(reach, away + m->geom_rbound[geom]);
  }
  return length(velocity) + length(spin) * reach;
}

}  // namespace

void update_ccd(const LawTables& laws, const mjModel* m, const mjData* d) {
  if (laws.stepped != reinterpret_cast<std::uintptr_t>(d) || !(laws.thin_speed > 0.0)) return;
  bool fast = false;
  for (int body = 1; body < m->nbody && !fast; ++body) {
    const bool moves = m->body_weldid[body] != 0 && m->body_geomnum[body] > 0;
    fast = moves && !(fastest_point(m, d, body) < laws.thin_speed);
  }
  int& flags = const_cast<mjModel*>(m)->opt.enableflags;
  flags = fast ? flags | mjENBL_SPECULATIVE : flags & ~mjENBL_SPECULATIVE;
}

}  // namespace trundle
