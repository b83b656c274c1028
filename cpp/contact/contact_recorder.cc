#include "contact_recorder.h"

#include <algorithm>
#include <utility>

namespace trundle {

namespace {

bool is_awake(const mjModel* m, const mjData* d, int geom) { return d->body_awake[m->geom_bodyid[geom]] == mjS_AWAKE; }

}  // namespace

ContactRow read_contact(const mjModel* m, const mjData* d, int contact) {
  const mjContact& source = d->contact[contact];
  double wrench[6];
  mujoco.mj_contactForce(m, d, contact, wrench);
  ContactRow row;
  for (int side = 0; side < 2; ++side) row.geom[side] = source.geom[side];
  for (int i = 0; i < 3; ++i) {
    row.position[i] = source.pos[i];
    row.normal[i] = source.frame[i];
    row.force[i] = row.torque[i] = 0;
    for (int j = 0; j < 3; ++j) {
      row.force[i] += source.frame[3 * j + i] * wrench[j];
      row.torque[i] += source.frame[3 * j + i] * wrench[3 + j];
    }
  }
  row.depth = -source.dist;
  return row;
}

SleepKey sleep_key(const mjModel* m, const mjData* d) {
  SleepKey key;
  if (!(m->opt.enableflags & mjENBL_SLEEP)) return key;
  for (int body = 0; body < m->nbody; ++body) {
    if (d->body_awake[body] != mjS_ASLEEP) continue;
    key.push_back(body);
    key.insert(key.end(), d->xpos + 3 * body, d->xpos + 3 * body + 3);
    key.insert(key.end(), d->xquat + 4 * body, d->xquat + 4 * body + 4);
  }
  return key;
}

ContactRecorder::ContactRecorder(const std::vector<int>& geoms, int geom_count, std::size_t max_steps)
    : geoms_(static_cast<std::size_t>(geom_count)), max_steps_(max_steps) {
  for (const int geom : geoms) geoms_.at(static_cast<std::size_t>(geom)) = 1;
}

void ContactRecorder::record(const mjModel* m, const mjData* d, std::int64_t time_ns, const SleepKey& key) {
  waiting_ = {time_ns, {}};
  for (int i = 0; i < d->ncon; ++i) {
    const int* geom = d->contact[i].geom;
    if (!has(geom[0]) && !has(geom[1])) continue;
    if (key.empty() || is_awake(m, d, geom[0]) || is_awake(m, d, geom[1]))
      waiting_.rows.push_back(read_contact(m, d, i));
  }
  stale_ = !key.empty() && key != key_;
  if (stale_) {
    key_ = key;
    return;
  }
  if (!key.empty()) waiting_.rows.insert(waiting_.rows.end(), sleeping_.begin(), sleeping_.end());
  keep(std::move(waiting_));
}

void ContactRecorder::set_sleeping(std::vector<ContactRow> rows) {
  sleeping_ = std::move(rows);
  stale_ = false;
  waiting_.rows.insert(waiting_.rows.end(), sleeping_.begin(), sleeping_.end());
  keep(std::move(waiting_));
}

void ContactRecorder::replace_since(std::int64_t time_ns, std::vector<ContactRow> rows) {
  while (!steps_.empty() && steps_.back().time_ns >= time_ns) steps_.pop_back();
  keep({time_ns, std::move(rows)});
}

void ContactRecorder::keep(RecordedStep step) {
  if (step.rows.empty()) return;
  steps_.push_back(std::move(step));
  if (steps_.size() > max_steps_) steps_.pop_front();
}

}  // namespace trundle
