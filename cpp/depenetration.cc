#include "depenetration.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace trundle {

namespace {

// Depth that comes out at max_vel [m]; of soft contacts any, for depth is what holds them.
//
// An overdamped contact of time constant t and damping ratio r, solved at the step's end, creeps out at
// depth / (2 t r² + h).
double most_depth(const LawTables& laws, const mjModel* m, const mjContact& contact) {
  const double time = contact.solref[0], ratio = contact.solref[1];
  if (!(time > 0)) return std::numeric_limits<double>::infinity();
  const double speed = std::min(laws.geoms[contact.geom[0]].max_vel, laws.geoms[contact.geom[1]].max_vel);
  return speed * (2 * time * ratio * ratio + m->opt.timestep);
}

}  // namespace

void mark_deep(const LawTables& laws, const mjModel* m, mjData* d) {
  std::fill(d->userdata, d->userdata + laws.marks, 0.0);
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (!(contact.includemargin - contact.dist > most_depth(laws, m, contact))) continue;
    for (const int geom : contact.geom) {
      const int flag = static_cast<int>(laws.geoms[geom].flag);
      if (flag >= 0) d->userdata[flag] = d->userdata[0] = 1.0;
    }
  }
}

bool limit_depth(const LawTables& laws, const mjModel* m, mjData* d) {
  if (!laws.parts) return false;
  thread_local std::vector<double> marks;
  marks.assign(laws.marks, 0.0);
  bool any = false;
  for (int i = 0; i < d->ncon; ++i) {
    mjContact& contact = d->contact[i];
    const double most = most_depth(laws, m, contact);
    if (!(contact.includemargin - contact.dist > most)) continue;
    const int flags[2] = {static_cast<int>(laws.geoms[contact.geom[0]].flag),
                          static_cast<int>(laws.geoms[contact.geom[1]].flag)};
    if (std::any_of(flags, flags + 2, [&](int flag) { return flag >= 0 && d->userdata[flag] == 0.0; })) continue;
    contact.dist = contact.includemargin - most;
    any = true;
    for (const int flag : flags) {
      if (flag >= 0) marks[flag] = marks[0] = 1.0;
    }
  }
  std::copy(marks.begin(), marks.end(), d->userdata);
  return any;
}

}  // namespace trundle
