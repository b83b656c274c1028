#include "friction_slip.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "contact_geometry.h"
#include "surface_motion.h"

namespace trundle {

namespace {

constexpr double kFrictionless = 1e-5;  // friction that MuJoCo treats as zero
constexpr double kMinSlipRatio = 0.1;   // ratio of slip to admittance; less slip is treated as none
constexpr int kRows = 4;                // normal, two tangents, torsion

// Slipping contact: along two tangents and about the normal.
struct SlippingContact {
  int contact, group;
  double side;           // 1: forces of the group are on the second body; -1: on the first
  double slip[3];        // [m/s/N], [rad/s/(N·m)]; 0: MuJoCo's friction holds
  double admittance[3];  // velocity that a unit force adds in one step, in the same units
  double friction[3];    // [-], [-], [m]
  double speed[3];       // speed of the surface [m/s]
  double force[3];       // applied force [N], [N], [N·m]
};

// Contacts that slip together: normal load, force and torsional torque of the previous step.
struct Group {
  double load, force[3], torque;
};

// Slip of a contact by the tables.
struct ContactSlip {
  double slip[3];
  double patch;  // see FrictionRow
  int group;
  double side;
};

thread_local std::vector<SlippingContact> slipping;
thread_local const mjData* slipping_in = nullptr;
thread_local std::vector<double> rows, solved, shares;  // reused between steps

Group* groups(const mjModel* m, mjData* d) { return reinterpret_cast<Group*>(d->userdata + m->nu + m->nv); }

// Add the slip of a moving surface, if one of the bodies has it.
bool add_motion(const LawTables& laws, const mjModel* m, const mjData* d, const mjContact& contact,
                ContactSlip& contact_slip) {
  const auto [motion, second] = motion_at(laws, contact);
  if (!motion || (motion->slip[0] <= 0 && motion->slip[1] <= 0)) return false;
  contact_slip.group = laws.body_of(contact.geom[second]);
  contact_slip.side = 2.0 * second - 1.0;
  const double scale =
      motion_kind(*motion) == MotionKind::kWheel ? std::abs(spin_of(d, contact_slip.group, *motion)) : 1.0;
  for (int t = 0; t < 2; ++t) contact_slip.slip[t] += motion->slip[t] * scale;
  return true;
}

bool find_slip(const LawTables& laws, const mjModel* m, const mjData* d, const mjContact& contact,
               ContactSlip& contact_slip) {
  contact_slip = {};
  if (contact.dim < 3 || contact.exclude != 0) return false;
  bool slips = false;
  if (laws.pair_groups > 0) {
    const FrictionRow* row = find_pair(laws.friction, pair_key(m, contact.geom));
    if (row && row->group >= 0) {
      std::copy(row->slip, row->slip + 3, contact_slip.slip);
      contact_slip.patch = row->patch;
      contact_slip.group = m->nbody + static_cast<int>(row->group);
      contact_slip.side = 1.0;
      slips = true;
    }
  }
  if (laws.moves) slips |= add_motion(laws, m, d, contact, contact_slip);
  return slips;
}

// Velocity that a unit force adds in one step, along the tangents and about the normal; needs the contact's Jacobian.
void find_admittance(const mjModel* m, mjData* d, double admittance[3]) {
  const int nv = m->nv;
  solved.resize(3 * nv);
  mujoco.mj_solveM(m, d, solved.data(), rows.data() + nv, 3);
  for (int t = 0; t < 3; ++t) {
    double sum = 0;
    for (int i = 0; i < nv; ++i) sum += rows[(t + 1) * nv + i] * solved[t * nv + i];
    admittance[t] = sum * m->opt.timestep;
  }
}

// Swap the tangents: the solver needs the direction with friction first.
void swap_tangents(mjContact& contact, SlippingContact& slider) {
  double* frame = contact.frame;
  for (int i = 0; i < 3; ++i) {
    const double first = frame[3 + i];
    frame[3 + i] = frame[6 + i];
    frame[6 + i] = -first;
  }
  const double run = contact.surfacevel[0];
  contact.surfacevel[0] = contact.surfacevel[1];
  contact.surfacevel[1] = -run;
  std::swap(contact.friction[0], contact.friction[1]);
  std::swap(slider.slip[0], slider.slip[1]);
  std::swap(slider.admittance[0], slider.admittance[1]);
}

// Switch off the friction of slipping directions; false: none slips.
bool release_contact(const mjModel* m, mjData* d, SlippingContact& slider) {
  thread_local ContactJacobian jacobian;
  mjContact& contact = d->contact[slider.contact];
  rows.resize(kRows * m->nv);
  jacobian.find(m, d, contact, rows.data(), kRows);
  find_admittance(m, d, slider.admittance);
  for (int t = 0; t < 3; ++t)
    if (slider.slip[t] < kMinSlipRatio * slider.admittance[t] || t + 2 > contact.dim) slider.slip[t] = 0.0;
  if (slider.slip[0] > 0.0 && slider.slip[1] == 0.0) swap_tangents(contact, slider);
  bool any = false;
  for (int t = 0; t < 3; ++t) {
    slider.friction[t] = contact.friction[t];
    slider.speed[t] = t < 2 ? contact.surfacevel[t] : 0.0;
    if (slider.slip[t] > 0.0) {
      contact.friction[t] = kFrictionless;
      any = true;
    }
  }
  return any;
}

// ODE's torsional friction grows with the contact patch, whose radius is the square root of depth times curvature
// radius; a load N on a stiffness kp is N / kp deep.
void set_torsional_friction(mjContact& contact, double patch, double load) {
  contact.friction[2] = std::max(std::sqrt(patch * load), kFrictionless);
}

// Force along one direction for which the velocity converges to slip · force, for any other forces.
//
// -speed / slip alone is unstable where the slip is below the admittance; the previous step's force accounts for the
// other forces.
double force_along(const SlippingContact& slider, int t, double share, double speed, double last) {
  return (slider.admittance[t] * last - speed) / (share * (slider.slip[t] + slider.admittance[t]));
}

void apply_force(const mjModel* m, mjData* d, SlippingContact& slider, Group& group, const Group& last, double share) {
  thread_local ContactJacobian jacobian;
  const int nv = m->nv;
  const mjContact& contact = d->contact[slider.contact];
  rows.resize(kRows * nv);
  jacobian.find(m, d, contact, rows.data(), kRows);
  double excess[3];
  double* force = slider.force;
  for (int t = 0; t < 3; ++t) {
    double speed = slider.speed[t];
    for (int i = 0; i < nv; ++i) speed += rows[(t + 1) * nv + i] * d->qvel[i];
    const double before = t < 2 ? dot(contact.frame + 3 * (t + 1), last.force) : last.torque;
    force[t] = slider.slip[t] > 0 ? force_along(slider, t, share, speed, slider.side * before) : 0.0;
    excess[t] = force[t] / std::max(slider.friction[t] * last.load / share, 1e-12);
  }
  if (slider.friction[0] == slider.friction[1])  // a cone; else a pyramid
    excess[0] = excess[1] = std::sqrt(excess[0] * excess[0] + excess[1] * excess[1]);
  for (int t = 0; t < 3; ++t) {
    force[t] /= std::max(std::abs(excess[t]), 1.0);
    for (int i = 0; i < nv; ++i) d->qfrc_passive[i] += force[t] * rows[(t + 1) * nv + i];
  }
  for (int i = 0; i < 3; ++i)
    group.force[i] += slider.side * (force[0] * contact.frame[3 + i] + force[1] * contact.frame[6 + i]);
  group.torque += slider.side * force[2];
}

// Write applied forces to the solver's rows, from which contact forces are read.
void report_slip_forces(mjData* d) {
  if (slipping_in != d) return;
  for (const SlippingContact& slider : slipping) {
    if (slider.contact >= d->ncon) return;
    const int first = d->contact[slider.contact].efc_address;
    for (int t = 0; first >= 0 && t < 3; ++t)
      if (slider.slip[t] > 0.0) d->efc_force[first + 1 + t] = slider.force[t];
  }
  slipping_in = nullptr;
}

}  // namespace

bool release_slipping(const LawTables& laws, const mjModel* m, mjData* d) {
  slipping.clear();
  slipping_in = d;
  if (!laws.moves && laws.pair_groups == 0) return false;
  shares.assign(static_cast<std::size_t>(m->nbody + laws.pair_groups), 0.0);
  ContactSlip contact_slip;
  for (int i = 0; i < d->ncon; ++i)
    if (find_slip(laws, m, d, d->contact[i], contact_slip)) shares[contact_slip.group] += 1.0;
  bool changed = false;
  for (int i = 0; i < d->ncon; ++i) {
    if (!find_slip(laws, m, d, d->contact[i], contact_slip)) continue;
    if (contact_slip.patch > 0) {
      set_torsional_friction(d->contact[i], contact_slip.patch,
                             groups(m, d)[contact_slip.group].load / shares[contact_slip.group]);
      changed = true;
    }
    SlippingContact slider{i,
                           contact_slip.group,
                           contact_slip.side,
                           {contact_slip.slip[0], contact_slip.slip[1], contact_slip.slip[2]},
                           {},
                           {},
                           {},
                           {}};
    if (*std::max_element(slider.slip, slider.slip + 3) > 0.0 && release_contact(m, d, slider))
      slipping.push_back(slider);
  }
  return changed || !slipping.empty();
}

void resist_slip(const LawTables& laws, const mjModel* m, mjData* d) {
  if (!laws.moves && laws.pair_groups == 0) return;
  Group* stored = groups(m, d);
  thread_local std::vector<Group> last;
  last.assign(stored, stored + m->nbody + laws.pair_groups);
  for (std::size_t i = 0; i < last.size(); ++i) stored[i] = {last[i].load, {}, {}};
  for (SlippingContact& slider : slipping)
    apply_force(m, d, slider, stored[slider.group], last[slider.group], shares[slider.group]);
}

void record_loads(const LawTables& laws, const mjModel* m, mjData* d) {
  if (!laws.moves && laws.pair_groups == 0) return;
  Group* stored = groups(m, d);
  for (int i = 0; i < m->nbody + laws.pair_groups; ++i) stored[i].load = 0.0;
  ContactSlip contact_slip;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address >= 0 && find_slip(laws, m, d, contact, contact_slip))
      stored[contact_slip.group].load += d->efc_force[contact.efc_address];
  }
  report_slip_forces(d);
}

}  // namespace trundle
