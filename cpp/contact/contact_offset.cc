#include "contact_offset.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "contact_geometry.h"
#include "friction_pyramid.h"
#include "mujoco_api.h"
#include "velocity_motor.h"

namespace trundle {

namespace {

// Change of tangential velocity in one step [m/s]; smaller ones lift a contact by under 0.1 mm.
constexpr double kMinRowJump = 0.02;
// Speed [m/s]; slower sliding lifts negligibly.
constexpr double kMinSpeed = 1e-6;

struct Spring {
  double stiffness, damping;  // stiffness and damping of a row [1/s², 1/s], by MuJoCo's rules for solref
};

Spring spring(const mjtNum* solref, double impedance) {
  const double d = impedance;
  if (solref[0] > 0) {
    const double time = d * solref[0], decay = time * solref[1];
    return {1 / std::max(decay * decay, mjMINVAL), 2 / std::max(time, mjMINVAL)};
  }
  return {-solref[0] / (d * d), -solref[1] / d};
}

// Height by which sliding would lift a contact [m]; accelerations: per constraint row, of the previous step, or of
// this one after a jump of a motor's command.
//
// A row's force is (reference − acceleration) / R. While a contact slides, its friction rows miss their reference by a
// residual, and the dual cone offsets the normal row by μ times that.
double lift(const mjContact& contact, const mjData* d, double h, const double* accelerations) {
  const double impedance = contact.solimp[1];
  const Spring normal = spring(contact.solref, impedance);
  const double decay = slip_decay(contact, h);
  const double stiffness = normal.stiffness * impedance;
  double residuals[6] = {};
  for (int j = 1; j < contact.dim; ++j) {
    const int row = contact.efc_address + j;
    residuals[j] = contact.friction[j - 1] * std::abs(accelerations[row] + decay * d->efc_vel[row]);
  }
  if (has_pyramid(contact)) {  // the dual norm of a pyramid is the sum of the two
    residuals[1] += residuals[2];
    residuals[2] = 0;
  }
  double sum = 0;
  for (const double residual : residuals) sum += residual * residual;
  // MuJoCo integrates the normal spring implicitly: its reference and R are divided by this factor.
  const double implicit_factor = 1 + h * normal.damping + h * h * stiffness;
  // At an impact the stopping force allows up to μ times as much friction, which the previous step did not have.
  const double max_friction = std::max(contact.friction[0], contact.friction[1]);
  const double impact = std::max(-d->efc_vel[contact.efc_address], 0.0) * normal.damping / implicit_factor;
  return std::max(std::sqrt(sum) - max_friction * max_friction * impact, 0.0) * implicit_factor / stiffness;
}

bool is_sliding(const mjContact& contact, const mjData* d) {
  double sum = 0;
  for (int j = 1; j < contact.dim; ++j) {
    const double speed = d->efc_vel[contact.efc_address + j];
    sum += speed * speed;
  }
  return sum > kMinSpeed * kMinSpeed;
}

// Kinematic trees of a contact, lower id first; -1: the world.
std::pair<int, int> trees(const mjModel* m, const mjContact& contact) {
  return std::minmax(m->body_treeid[m->geom_bodyid[contact.geom[0]]], m->body_treeid[m->geom_bodyid[contact.geom[1]]]);
}

// Effort by which friction holds a degree of freedom [N·m or N], with a safety factor of 2. Each contact of two trees
// is assumed to carry an equal share of the lighter tree. column: column of the degree of freedom in the constraint
// Jacobian.
double holding_effort(const mjModel* m, const mjData* d, const double* column) {
  double sum = 0;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0 || contact.dim < 3) continue;
    const auto both = trees(m, contact);
    const auto alike = [&](const mjContact& other) { return trees(m, other) == both; };
    const auto points = std::count_if(d->contact, d->contact + d->ncon, alike);
    double mass = mjMAXVAL;
    for (const int tree : {both.first, both.second})
      if (tree >= 0) mass = std::min(mass, m->body_subtreemass[m->tree_bodyadr[tree]]);
    const double* tangential = column + contact.efc_address + 1;
    const double load = 2.0 * std::sqrt(dot(m->opt.gravity, m->opt.gravity)) * mass / static_cast<double>(points);
    sum += load * std::hypot(contact.friction[0] * tangential[0], contact.friction[1] * tangential[1]);
  }
  return sum;
}

// Accelerations per constraint row, computed on demand.
class Accelerations {
 public:
  Accelerations(const LawTables& laws, const mjModel* m, mjData* d) : m_(m), d_(d) {
    thread_local std::vector<Jump> jumps;
    thread_local std::vector<double> unit;
    find_jumps(laws, m, d, jumps);
    for (const Jump& jump : jumps) {
      unit.assign(m->nv, 0.0);
      unit[jump.dof] = 1.0;
      find_row_accelerations(unit.data(), after_);
      const double max_acceleration = (jump.effort - holding_effort(m, d, after_.data())) * m->dof_invweight0[jump.dof];
      if (max_acceleration <= 0.0) continue;
      if (!jumps_) now_.assign(d->qacc_warmstart, d->qacc_warmstart + m->nv);
      now_[jump.dof] = std::clamp(jump.acceleration, -max_acceleration, max_acceleration);
      jumps_ = true;
    }
    if (jumps_) find_row_accelerations(now_.data(), after_);
  }

  // Constraint-row accelerations of the previous step.
  const double* before() {
    if (!known_) find_row_accelerations(d_->qacc_warmstart, before_);
    known_ = true;
    return before_.data();
  }

  // Constraint-row accelerations of this step, if a jump of a motor's command makes the contact slide; else null.
  const double* after_jump(const mjContact& contact) {
    if (!jumps_) return nullptr;
    double sum = 0;
    for (int row = contact.efc_address + 1; row < contact.efc_address + contact.dim; ++row) {
      const double change = m_->opt.timestep * (after_[row] - before()[row]);
      sum += change * change;
    }
    return sum > kMinRowJump * kMinRowJump ? after_.data() : nullptr;
  }

 private:
  void find_row_accelerations(const double* accelerations, std::vector<double>& rows) {
    rows.resize(d_->nefc);
    mujoco.mj_mulJacVec(m_, d_, rows.data(), accelerations);
  }

  const mjModel* m_;
  mjData* d_;
  bool jumps_ = false, known_ = false;
  static thread_local std::vector<double> now_, before_, after_;  // reused between steps
};

thread_local std::vector<double> Accelerations::now_, Accelerations::before_, Accelerations::after_;

// Depth x at which our spring carries the load that Gazebo's ODE carries when resting at `depth`. ODE caps the
// correction rate · depth at max_vel, so points sink until later steps correct as much: physics/compile/compliance.py,
// rest_depth.
//
// With w = gravity · h, ODE rests at depth = x (1 + (rate x − max_vel) / w) if that exceeds x; solved here for x.
double carrying_depth(const ComplianceRow& row, double depth, double w) {
  if (row.rate <= 0 || row.rate * depth <= row.max_vel) return depth;
  const double linear = w - row.max_vel;
  return (std::sqrt(linear * linear + 4 * row.rate * w * depth) - linear) / (2 * row.rate);
}

}  // namespace

double slip_decay(const mjContact& contact, double h) {
  const bool has_friction_solref = contact.solreffriction[0] != 0 || contact.solreffriction[1] != 0;
  const double damping =
      spring(has_friction_solref ? contact.solreffriction : contact.solref, contact.solimp[1]).damping;
  return damping / (1 + h * damping);
}

void apply_compliance(const LawTables& laws, const mjModel* m, mjData* d) {
  if (laws.compliance.empty()) return;
  const double gravity_step = std::sqrt(dot(m->opt.gravity, m->opt.gravity)) * m->opt.timestep;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0) continue;
    const ComplianceRow* row = find_pair(laws.compliance, pair_key(m, contact.geom));
    if (!row) continue;
    double& margin = d->efc_margin[contact.efc_address];
    if (row->depth > 0) margin = std::max(contact.dist, -row->depth);
    margin = contact.dist + row->factor * carrying_depth(*row, margin - contact.dist, gravity_step);
  }
}

void hold_sliding(const LawTables& laws, const mjModel* m, mjData* d) {
  if (m->opt.integrator != mjINT_DISCRETE || m->opt.cone != mjCONE_ELLIPTIC) return;
  Accelerations accelerations(laws, m, d);
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0) continue;
    if (contact.dim < 3) continue;
    const double* after = accelerations.after_jump(contact);
    if (!after && !is_sliding(contact, d)) continue;
    d->efc_margin[contact.efc_address] -= lift(contact, d, m->opt.timestep, after ? after : accelerations.before());
  }
}

}  // namespace trundle
