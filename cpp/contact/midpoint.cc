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

int tree_of(const ChainRow& row) { return static_cast<int>(row.tree); }

VelocityTime time_of(const mjModel* m, const mjData* d, const ChainRow& row) {
  return static_cast<VelocityTime>(static_cast<int>(d->userdata[m->nu + m->tree_dofadr[tree_of(row)]]));
}

void set_time(const mjModel* m, mjData* d, const ChainRow& row, VelocityTime time) {
  std::fill_n(d->userdata + m->nu + m->tree_dofadr[tree_of(row)], m->tree_dofnum[tree_of(row)],
              static_cast<double>(time));
}

// Add half a step of the last step's acceleration, times a sign, to a tree's velocities; write what was added.
void add_half_step(const mjModel* m, mjData* d, int tree, double sign = 1.0, double* added = nullptr) {
  const int first = m->tree_dofadr[tree], last = first + m->tree_dofnum[tree];
  for (int i = first; i < last; ++i) {
    const double change = sign * 0.5 * m->opt.timestep * d->qacc_warmstart[i];
    d->qvel[i] += change;
    if (added) added[i] = change;
  }
}

constexpr char kDriven = 2;  // tree is driven; 1: it is in contact

// Mark trees coupled by constraints like the trees they are coupled to.
void spread_held(const mjModel* m, const mjData* d, std::vector<char>& held) {
  const auto tree_of = [&](int equality, int id) {
    if (id < 0) return -1;
    if (m->eq_type[equality] == mjEQ_JOINT) return m->dof_treeid[m->jnt_dofadr[id]];
    return m->eq_objtype[equality] == mjOBJ_BODY ? m->body_treeid[id] : -1;
  };
  for (bool spreads = true; spreads;) {
    spreads = false;
    for (int i = 0; i < m->neq; ++i) {
      const int one = tree_of(i, m->eq_obj1id[i]), other = tree_of(i, m->eq_obj2id[i]);
      if (!d->eq_active[i] || one < 0 || other < 0 || held[one] == held[other]) continue;
      held[one] = held[other] = held[one] | held[other];
      spreads = true;
    }
  }
}

// Actions on each tree other than gravity, inertia, springs, dampers and joint friction.
const std::vector<char>& find_held(const LawTables& laws, const mjModel* m, const mjData* d) {
  thread_local std::vector<char> held;
  held = find_touching(m, d);
  const auto hold = [&](int tree) {
    if (tree >= 0) held[tree] |= kDriven;
  };
  for (std::size_t i = 0; i < laws.motors.size(); ++i)
    if (m->tendon_frictionloss[i] > 0.0) hold(m->dof_treeid[static_cast<int>(laws.motors[i].dof)]);
  for (int row = d->ne + d->nf; row < d->ne + d->nf + d->nl; ++row)  // limits that a joint reaches within the step
    if (d->efc_pos[row] + m->opt.timestep * d->efc_vel[row] <= 0.0) hold(m->dof_treeid[m->jnt_dofadr[d->efc_id[row]]]);
  for (const DampingRow& row : laws.damping) hold(m->body_treeid[static_cast<int>(row.body)]);
  for (int i = 0; i < m->nv; ++i)
    if (d->qfrc_applied[i] != 0.0) hold(m->dof_treeid[i]);
  for (int body = 1; body < m->nbody; ++body) {
    const double* wrench = d->xfrc_applied + 6 * body;
    if (std::any_of(wrench, wrench + 6, [](double component) { return component != 0.0; })) hold(m->body_treeid[body]);
  }
  spread_held(m, d, held);
  return held;
}

// Trees with moving chains; among trees in contact, only those that swing.
void find_chains(const LawTables& laws, const mjModel* m, const mjData* d, std::vector<int>& chains) {
  chains.clear();
  if (laws.chains.empty()) return;
  const std::vector<char>& touching = find_touching(m, d);
  for (const ChainRow& row : laws.chains) {
    const int tree = tree_of(row);
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

void update_midpoints(const LawTables& laws, const mjModel* m, mjData* d) {
  const auto is_settled = [&](const ChainRow& row) {
    return row.hangs == 0.0 || time_of(m, d, row) == VelocityTime::kPosition || d->tree_asleep[tree_of(row)] >= 0;
  };
  if (std::all_of(laws.chains.begin(), laws.chains.end(), is_settled)) return;
  thread_local std::vector<double> moved;
  moved.assign(m->nv, 0.0);
  const std::vector<char>& held = find_held(laws, m, d);
  bool any = false;
  for (const ChainRow& row : laws.chains) {
    if (is_settled(row)) continue;
    const VelocityTime time = time_of(m, d, row);
    const char holds = held[tree_of(row)];
    if (holds) set_time(m, d, row, VelocityTime::kPosition);
    else set_time(m, d, row, time == VelocityTime::kWritten ? VelocityTime::kStepped : VelocityTime::kMidpoint);
    // For contact laws the velocity is the one that led to the current depth.
    const bool starts = !holds && time == VelocityTime::kStepped;
    const bool ends = holds == kDriven && time == VelocityTime::kMidpoint;
    if (starts) add_half_step(m, d, tree_of(row), -1.0, moved.data());
    if (ends) add_half_step(m, d, tree_of(row));
    any |= starts || ends;
  }
  if (!any) return;
  mujoco.mj_integratePos(m, d->qpos, moved.data(), m->opt.timestep);
  mujoco.mj_fwdVelocity(m, d);
}

void read_velocities(const LawTables& laws, const mjModel* m, mjData* d) {
  for (const ChainRow& row : laws.chains)
    if (time_of(m, d, row) == VelocityTime::kMidpoint) add_half_step(m, d, tree_of(row));
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
  for (const int tree : chains) add_half_step(m, d, tree);
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

void add_springs(const LawTables& laws, mjData* d) {
  for (const SpringRow& row : laws.springs) {
    const int dof = static_cast<int>(row.dof);
    d->qfrc_passive[dof] -= row.stiffness * (d->qpos[static_cast<int>(row.qpos)] - row.reference);
    d->qfrc_passive[dof] -= row.damping * d->qvel[dof];
  }
}

}  // namespace trundle
