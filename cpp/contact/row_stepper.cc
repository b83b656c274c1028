#include "row_stepper.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "law_tables.h"
#include "midpoint.h"
#include "mujoco_api.h"

namespace trundle {

namespace {

constexpr int kDiverged[] = {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC};

// Set the motors of a thread's model to a row's.
void set_motors(mjModel* m, const LawTables& laws, const WorldRows& rows, std::size_t row, bool always) {
  const auto motors = static_cast<std::size_t>(m->ntendon);
  const double* efforts = rows.max_efforts + row * motors;
  std::copy_n(efforts, motors, m->tendon_frictionloss);
  for (std::size_t i = 0; i < motors; ++i) const_cast<MotorRow&>(laws.motors[i]).rate = rows.rates[row * motors + i];
  const bool on = always || std::any_of(efforts, efforts + motors, [](double effort) { return effort != 0.0; });
  m->opt.disableflags = on ? m->opt.disableflags & ~mjDSBL_ACTUATION : m->opt.disableflags | mjDSBL_ACTUATION;
  if (laws.thin_speed > 0.0) m->opt.enableflags |= mjENBL_SPECULATIVE;  // on, until a step finds all bodies slow
}

}  // namespace

void RowStepper::step(const WorldRows& rows, int steps) const {
  std::atomic<std::size_t> next = 0;
  const auto work = [&](const std::pair<mjModel*, mjData*>& worker) {
    const auto [m, d] = worker;
    LawTables laws;
    LawTables::find(m, laws);
    for (std::size_t row = next++; row < rows.count; row = next++) {
      if (!rows.chosen[row]) continue;
      set_motors(m, laws, rows, row, always_);
      step_row(m, d, rows, row, steps);
    }
  };
  const auto chosen = static_cast<std::size_t>(std::count(rows.chosen, rows.chosen + rows.count, true));
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < std::min(workers_.size(), chosen); ++i) threads.emplace_back(work, workers_[i]);
  work(workers_.front());
  for (std::thread& thread : threads) thread.join();
}

void RowStepper::step_row(const mjModel* m, mjData* d, const WorldRows& rows, std::size_t row, int steps) const {
  double* state = rows.states + row * static_cast<std::size_t>(mujoco.mj_stateSize(m, mjSTATE_INTEGRATION));
  for (const int kind : kDiverged) d->warning[kind].number = 0;
  mujoco.mj_setState(m, d, state, mjSTATE_INTEGRATION);
  bool stable = true;
  for (int i = 0; i < steps && stable; ++i) {
    mujoco.mj_step(m, d);
    stable = is_stable(m, d);
  }
  rows.unstable[row] = !stable;
  if (stable) mujoco.mj_getState(m, d, state, mjSTATE_INTEGRATION);
  else mujoco.mj_setState(m, d, state, mjSTATE_INTEGRATION);
  write_links(m, d, rows, row);
}

bool RowStepper::is_stable(const mjModel* m, const mjData* d) const {
  for (const int kind : kDiverged)
    if (d->warning[kind].number > 0) return false;
  return std::all_of(d->qvel, d->qvel + m->nv, [&](double speed) { return std::abs(speed) < max_speed_; });
}

void RowStepper::write_links(const mjModel* m, mjData* d, const WorldRows& rows, std::size_t row) const {
  LawTables laws;
  if (LawTables::find(m, laws)) read_velocities(laws, m, d);
  mujoco.mj_kinematics(m, d);
  mujoco.mj_comPos(m, d);
  mujoco.mj_comVel(m, d);
  double* pose = rows.poses + row * links_.size() * 7;
  double* twist = rows.twists + row * links_.size() * 6;
  for (const int body : links_) {
    const double *at = d->xpos + 3 * body, *velocity = d->cvel + 6 * body;
    const double* centre = d->subtree_com + 3 * m->body_rootid[body];
    std::copy_n(at, 3, pose);
    std::copy_n(d->xquat + 4 * body, 4, pose + 3);
    // cvel refers to the tree's centre of mass.
    const double x = at[0] - centre[0], y = at[1] - centre[1], z = at[2] - centre[2];
    twist[0] = velocity[3] + velocity[1] * z - velocity[2] * y;
    twist[1] = velocity[4] + velocity[2] * x - velocity[0] * z;
    twist[2] = velocity[5] + velocity[0] * y - velocity[1] * x;
    std::copy_n(velocity, 3, twist + 3);
    pose += 7;
    twist += 6;
  }
}

}  // namespace trundle
