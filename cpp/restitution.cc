#include "restitution.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact_geometry.h"

namespace trundle {

namespace {

constexpr int kSweeps = 50;
constexpr int kRounds = 50;  // what an impulse sets in motion hits what it touches in the next round of the same step

struct Impact {
  double speed;  // [m/s] to leave at
  double friction[2];
};

// How gravity speeds the approach up [m/s²]; two bodies that both fall, not at all.
double pull(const mjModel* m, const mjContact& contact) {
  const auto moves = [&](int side) { return m->body_weldid[m->geom_bodyid[contact.geom[side]]] != 0 ? 1 : 0; };
  return dot(contact.frame, m->opt.gravity) * (moves(0) - moves(1));
}

// The speed to leave at [m/s]: e times what it was at the surface, and what the way back to it takes.
//
// Steps that change the speed by a h and then the position by speed · h keep v² / 2 + a x - a h v / 2, x [m] away from
// the surface and a the pull towards it.
double leaving_speed(double restitution, double approach, double depth, double pull, double h) {
  const double half = pull * h / 2;
  const double at_surface = std::max(approach * approach + 2 * half * approach - 2 * pull * depth, 0.0);
  return half + std::sqrt(std::max(half * half + restitution * restitution * at_surface + 2 * pull * depth, 0.0));
}

// Impulses of all contacts at once; memory is kept from step to step.
class Impacts {
 public:
  void find(const LawTables& laws, const mjModel* m, const mjData* d);
  bool empty() const { return impacts_.empty(); }
  void push(const mjModel* m, mjData* d);

 private:
  void relax();
  double change(int row) const;

  ContactJacobian jacobian_;
  std::vector<Impact> impacts_;
  std::vector<double> rows_, reach_, effect_, velocity_, impulse_;
};

void Impacts::find(const LawTables& laws, const mjModel* m, const mjData* d) {
  impacts_.clear();
  rows_.clear();
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0) continue;  // all others MuJoCo would stop, those a margin apart, too
    const RestitutionRow* row = find_pair(laws.restitution, pair_key(m, contact.geom));
    if (!row || !(approach_speed(m, d, contact) > row->slowest * (1 - 1e-6))) continue;
    const std::size_t size = rows_.size();
    rows_.resize(size + 3 * m->nv);
    jacobian_.find(m, d, contact, rows_.data() + size);
    double speed = 0;
    for (int j = 0; j < m->nv; ++j) speed += rows_[size + j] * d->qvel[j];
    if (-speed <= row->slowest) {
      rows_.resize(size);
      continue;
    }
    const double leaving = leaving_speed(row->restitution, -speed, -contact.dist, pull(m, contact), m->opt.timestep);
    impacts_.push_back({leaving, {contact.friction[0], contact.friction[1]}});
  }
}

void Impacts::push(const mjModel* m, mjData* d) {
  const int nv = m->nv, count = static_cast<int>(3 * impacts_.size());
  reach_.resize(rows_.size());
  mujoco.mj_solveM(m, d, reach_.data(), rows_.data(), count);
  effect_.assign(static_cast<std::size_t>(count) * count, 0.0);
  velocity_.assign(count, 0.0);
  for (int i = 0; i < count; ++i) {
    const double* row = rows_.data() + static_cast<std::size_t>(i) * nv;
    for (int k = 0; k < nv; ++k) {
      if (row[k] == 0.0) continue;
      velocity_[i] += row[k] * d->qvel[k];
      for (int j = 0; j < count; ++j) effect_[i * count + j] += row[k] * reach_[static_cast<std::size_t>(j) * nv + k];
    }
  }
  impulse_.assign(count, 0.0);
  relax();
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < nv; ++k) d->qvel[k] += reach_[static_cast<std::size_t>(i) * nv + k] * impulse_[i];
  }
}

void Impacts::relax() {
  const int count = static_cast<int>(impulse_.size());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int i = 0; i < count / 3; ++i) {
      const Impact& impact = impacts_[i];
      const int n = 3 * i;
      const double stiff = effect_[n * count + n];
      impulse_[n] = std::max(impulse_[n] + (impact.speed - change(n)) / stiff, 0.0);
      double wanted[2], share[2];
      for (int t = 0; t < 2; ++t) {
        const int row = n + 1 + t;
        wanted[t] = impulse_[row] - change(row) / std::max(effect_[row * count + row], 1e-12);
        share[t] = wanted[t] / std::max(impulse_[n] * impact.friction[t], 1e-12);
      }
      const double over = std::max(std::sqrt(share[0] * share[0] + share[1] * share[1]), 1.0);
      for (int t = 0; t < 2; ++t) impulse_[n + 1 + t] = wanted[t] / over;
    }
  }
}

// The speed of a row with the impulses so far.
double Impacts::change(int row) const {
  const std::size_t count = impulse_.size();
  double speed = velocity_[row];
  for (std::size_t j = 0; j < count; ++j) speed += effect_[row * count + j] * impulse_[j];
  return speed;
}

}  // namespace

bool apply_restitution(const LawTables& laws, const mjModel* m, mjData* d) {
  thread_local Impacts impacts;
  for (int round = 0; round < kRounds; ++round) {
    impacts.find(laws, m, d);
    if (impacts.empty()) return round > 0;
    impacts.push(m, d);
    mujoco.mj_comVel(m, d);  // by which `find` knows what approaches
  }
  return true;
}

}  // namespace trundle
