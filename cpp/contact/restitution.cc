#include "restitution.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact_geometry.h"

namespace trundle {

namespace {

constexpr int kMaxSweeps = 50;
constexpr int kMaxRounds = 50;  // iterations over the impulses of one step

struct Impact {
  double speed;  // [m/s] after the impact
  double friction[2];
};

// Gravity along the approach [m/s²]; 0 between two bodies that both fall.
double approach_acceleration(const mjModel* m, const mjContact& contact) {
  const auto moves = [&](int side) { return m->body_weldid[m->geom_bodyid[contact.geom[side]]] != 0 ? 1 : 0; };
  return dot(contact.frame, m->opt.gravity) * (moves(0) - moves(1));
}

// Speed after the impact [m/s]: e times the speed at the surface, plus the loss on the way back to the surface.
//
// Semi-implicit Euler steps conserve v² / 2 + a x - a h v / 2 at height x above the surface with acceleration a towards
// it.
double leaving_speed(double restitution, double approach, double depth, double approach_acceleration, double h) {
  const double half = approach_acceleration * h / 2;
  const double at_surface =
      std::max(approach * approach + 2 * half * approach - 2 * approach_acceleration * depth, 0.0);
  return half + std::sqrt(std::max(
                    half * half + restitution * restitution * at_surface + 2 * approach_acceleration * depth, 0.0));
}

// Impulses of all contacts of a step; the memory is reused.
class Impacts {
 public:
  void find(const LawTables& laws, const mjModel* m, const mjData* d);
  bool empty() const { return impacts_.empty(); }
  void apply(const mjModel* m, mjData* d);

 private:
  void relax();
  double change(int row) const;

  ContactJacobian jacobian_;
  std::vector<Impact> impacts_;
  std::vector<double> rows_, solved_, admittance_, velocity_, impulse_;
};

void Impacts::find(const LawTables& laws, const mjModel* m, const mjData* d) {
  impacts_.clear();
  rows_.clear();
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0) continue;  // a contact that is not in the solver
    const RestitutionRow* row = find_pair(laws.restitution, pair_key(m, contact.geom));
    if (!row || !(approach_speed(m, d, contact) > row->min_speed * (1 - 1e-6))) continue;
    const std::size_t size = rows_.size();
    rows_.resize(size + 3 * m->nv);
    jacobian_.find(m, d, contact, rows_.data() + size);
    double speed = 0;
    for (int j = 0; j < m->nv; ++j) speed += rows_[size + j] * d->qvel[j];
    if (-speed <= row->min_speed) {
      rows_.resize(size);
      continue;
    }
    const double leaving =
        leaving_speed(row->restitution, -speed, -contact.dist, approach_acceleration(m, contact), m->opt.timestep);
    impacts_.push_back({leaving, {contact.friction[0], contact.friction[1]}});
  }
}

void Impacts::apply(const mjModel* m, mjData* d) {
  const int nv = m->nv, count = static_cast<int>(3 * impacts_.size());
  solved_.resize(rows_.size());
  mujoco.mj_solveM(m, d, solved_.data(), rows_.data(), count);
  admittance_.assign(static_cast<std::size_t>(count) * count, 0.0);
  velocity_.assign(count, 0.0);
  for (int i = 0; i < count; ++i) {
    const double* row = rows_.data() + static_cast<std::size_t>(i) * nv;
    for (int k = 0; k < nv; ++k) {
      if (row[k] == 0.0) continue;
      velocity_[i] += row[k] * d->qvel[k];
      for (int j = 0; j < count; ++j)
        admittance_[i * count + j] += row[k] * solved_[static_cast<std::size_t>(j) * nv + k];
    }
  }
  impulse_.assign(count, 0.0);
  relax();
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < nv; ++k) d->qvel[k] += solved_[static_cast<std::size_t>(i) * nv + k] * impulse_[i];
}

void Impacts::relax() {
  const int count = static_cast<int>(impulse_.size());
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    for (int i = 0; i < count / 3; ++i) {
      const Impact& impact = impacts_[i];
      const int n = 3 * i;
      const double stiff = admittance_[n * count + n];
      impulse_[n] = std::max(impulse_[n] + (impact.speed - change(n)) / stiff, 0.0);
      double target[2], ratio[2];
      for (int t = 0; t < 2; ++t) {
        const int row = n + 1 + t;
        target[t] = impulse_[row] - change(row) / std::max(admittance_[row * count + row], 1e-12);
        ratio[t] = target[t] / std::max(impulse_[n] * impact.friction[t], 1e-12);
      }
      if (impact.friction[0] == impact.friction[1])  // a cone; else a pyramid
        ratio[0] = ratio[1] = std::sqrt(ratio[0] * ratio[0] + ratio[1] * ratio[1]);
      for (int t = 0; t < 2; ++t) impulse_[n + 1 + t] = target[t] / std::max(std::abs(ratio[t]), 1.0);
    }
  }
}

// Velocity of a row with the impulses so far.
double Impacts::change(int row) const {
  const std::size_t count = impulse_.size();
  double speed = velocity_[row];
  for (std::size_t j = 0; j < count; ++j) speed += admittance_[row * count + j] * impulse_[j];
  return speed;
}

}  // namespace

bool apply_restitution(const LawTables& laws, const mjModel* m, mjData* d) {
  thread_local Impacts impacts;
  for (int round = 0; round < kMaxRounds; ++round) {
    impacts.find(laws, m, d);
    if (impacts.empty()) return round > 0;
    impacts.apply(m, d);
    mujoco.mj_comVel(m, d);  // `find` reads d->cvel
  }
  return true;
}

}  // namespace trundle
