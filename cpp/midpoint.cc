#include "midpoint.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mujoco_api.h"

namespace trundle {

namespace {

constexpr double kMinSpeed = 1e-3;  // [rad/s or m/s] slower joints have negligible Coriolis forces

bool moves(double speed) { return std::abs(speed) > kMinSpeed; }

// True if a moving joint has a moving ancestor; wheels on a body have negligible Coriolis forces.
bool swings(const mjModel* m, const mjData* d, int tree) {
  const int first = m->tree_dofadr[tree], last = first + m->tree_dofnum[tree];
  const int first_joint = m->jnt_type[m->dof_jntid[first]] == mjJNT_FREE ? first + 6 : first;
  for (int i = first_joint; i < last; ++i) {
    if (!moves(d->qvel[i])) continue;
    for (int above = m->dof_parentid[i]; above >= first_joint; above = m->dof_parentid[above])
      if (moves(d->qvel[above])) return true;
  }
  return false;
}

// True if a tree hangs from something fixed and has a ball joint; others keep the velocities that they are given, which
// are of the start of a step.
bool has_ball(const mjModel* m, int tree) {
  const int first = m->tree_dofadr[tree], last = first + m->tree_dofnum[tree];
  bool found = false;
  for (int i = first; i < last; ++i) {
    if (m->jnt_type[m->dof_jntid[i]] == mjJNT_FREE) return false;
    found |= m->jnt_type[m->dof_jntid[i]] == mjJNT_BALL;
  }
  return found;
}

// Trees in contact, one flag each.
const std::vector<char>& find_touching(const mjModel* m, const mjData* d) {
  thread_local std::vector<char> touching;
  touching.assign(m->ntree, 0);
  for (int i = 0; i < d->ncon; ++i) {
    for (const int geom : d->contact[i].geom) {
      const int tree = m->body_treeid[m->geom_bodyid[geom]];
      if (tree >= 0) touching[tree] = 1;
    }
  }
  return touching;
}

// Degrees of freedom in the air whose velocities are new; they count as midpoints' from now on.
void find_started(const LawTables& laws, const mjModel* m, mjData* d, std::vector<int>& started) {
  started.clear();
  double* known = d->userdata + m->nu;
  for (const ChainRow& row : laws.chains) {
    const int tree = static_cast<int>(row.tree), first = m->tree_dofadr[tree], last = first + m->tree_dofnum[tree];
    if (!has_ball(m, tree)) continue;
    for (int i = first; i < last; ++i) {
      if (known[i] != 0.0) continue;
      known[i] = 1.0;
      if (!find_touching(m, d)[tree]) started.push_back(i);
    }
  }
}

// Trees with moving chains; of those in contact, only the ones that swing.
void find_chains(const LawTables& laws, const mjModel* m, const mjData* d, std::vector<int>& chains) {
  chains.clear();
  if (laws.chains.empty()) return;
  const std::vector<char>& touching = find_touching(m, d);
  for (const ChainRow& row : laws.chains) {
    const int tree = static_cast<int>(row.tree);
    const double* speeds = d->qvel + m->tree_dofadr[tree];
    const bool counts = touching[tree] ? swings(m, d, tree) : std::any_of(speeds, speeds + m->tree_dofnum[tree], moves);
    if (counts) chains.push_back(tree);
  }
}

// Degrees of freedom moved by kinematic motors.
void find_driven(const LawTables& laws, const mjModel* m, const mjData* d, std::vector<int>& driven) {
  driven.clear();
  for (std::size_t i = 0; i < laws.motors.size(); ++i) {
    const int dof = static_cast<int>(laws.motors[i].dof);
    if (laws.motors[i].is_kinematic() && m->tendon_frictionloss[i] > 0.0 && moves(d->qvel[dof])) driven.push_back(dof);
  }
}

}  // namespace

void start_at_midpoint(const LawTables& laws, const mjModel* m, mjData* d) {
  thread_local std::vector<int> started;
  thread_local std::vector<double> forces, accelerations;
  find_started(laws, m, d, started);
  if (started.empty()) return;
  forces.assign(d->qfrc_passive, d->qfrc_passive + m->nv);
  for (int i = 0; i < m->nv; ++i) forces[i] += d->qfrc_applied[i] - d->qfrc_bias[i];
  add_springs(laws, d, forces.data());
  for (int body = 1; body < m->nbody; ++body) {
    const double* wrench = d->xfrc_applied + 6 * body;
    if (std::any_of(wrench, wrench + 6, [](double each) { return each != 0.0; }))
      mujoco.mj_applyFT(m, d, wrench, wrench + 3, d->xipos + 3 * body, body, forces.data());
  }
  accelerations.resize(m->nv);
  mujoco.mj_solveM(m, d, accelerations.data(), forces.data(), 1);
  for (const int i : started) d->qvel[i] -= 0.5 * m->opt.timestep * accelerations[i];
  mujoco.mj_fwdVelocity(m, d);
}

void apply_midpoint_bias(const LawTables& laws, const mjModel* m, mjData* d) {
  thread_local std::vector<int> chains, driven;
  thread_local std::vector<double> speeds, velocities, axes, bias;
  find_chains(laws, m, d, chains);
  find_driven(laws, m, d, driven);
  if (chains.empty() && driven.empty()) return;
  speeds.assign(d->qvel, d->qvel + m->nv);
  velocities.assign(d->cvel, d->cvel + 6 * m->nbody);
  axes.assign(d->cdof_dot, d->cdof_dot + 6 * m->nv);
  bias.resize(m->nv);
  for (const int tree : chains)
    for (int i = m->tree_dofadr[tree]; i < m->tree_dofadr[tree] + m->tree_dofnum[tree]; ++i)
      d->qvel[i] += 0.5 * m->opt.timestep * d->qacc_warmstart[i];
  for (const int dof : driven) {
    d->qvel[dof] = 0.0;
    const int tree = m->dof_treeid[dof];
    if (std::find(chains.begin(), chains.end(), tree) == chains.end()) chains.push_back(tree);
  }
  mujoco.mj_comVel(m, d);
  mujoco.mj_rne(m, d, 0, bias.data());
  for (const int tree : chains) {
    const int first = m->tree_dofadr[tree];
    std::copy(bias.begin() + first, bias.begin() + first + m->tree_dofnum[tree], d->qfrc_bias + first);
  }
  std::copy(speeds.begin(), speeds.end(), d->qvel);
  std::copy(velocities.begin(), velocities.end(), d->cvel);
  std::copy(axes.begin(), axes.end(), d->cdof_dot);
}

void add_springs(const LawTables& laws, const mjData* d, double* forces) {
  for (const SpringRow& row : laws.springs)
    forces[static_cast<int>(row.dof)] -= row.stiffness * (d->qpos[static_cast<int>(row.qpos)] - row.reference);
}

}  // namespace trundle
