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

// Trees with moving chains; of those in contact, only the ones that swing.
void find_chains(const LawTables& laws, const mjModel* m, const mjData* d, std::vector<int>& chains) {
  chains.clear();
  if (laws.chains.empty()) return;
  thread_local std::vector<char> touching;
  touching.assign(m->ntree, 0);
  for (int i = 0; i < d->ncon; ++i) {
    for (const int geom : d->contact[i].geom) {
      const int tree = m->body_treeid[m->geom_bodyid[geom]];
      if (tree >= 0) touching[tree] = 1;
    }
  }
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

void apply_springs(const LawTables& laws, const mjModel* m, mjData* d) {
  (void)m;
  for (const SpringRow& row : laws.springs)
    d->qfrc_passive[static_cast<int>(row.dof)] -= row.stiffness * (d->qpos[static_cast<int>(row.qpos)] - row.reference);
}

}  // namespace trundle
