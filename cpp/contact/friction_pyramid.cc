#include "friction_pyramid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_geometry.h"
#include "contact_offset.h"

namespace trundle {

namespace {

constexpr double kMaxAspect = 50.0;  // longer ellipses cost the solver's precision; a creep of 1 / 50² slip remains
constexpr double kMaxRatio =
    500.0;  // of the coefficients: beyond, MuJoCo's ellipse differs by less than the smaller one
constexpr double kMaxFriction = 2.0;  // beyond, MuJoCo's ellipse differs little under a pull
constexpr double kStill = 1e-12;      // [m/s²] no slip

// Acceleration missing in a friction direction of a contact to end the slip [m/s²]: as in the previous step, and
// if that exceeded the solver's, scaled with the slip.
double predict_lack(const mjModel* m, const mjData* d, const mjContact& contact, int direction) {
  const int row = contact.efc_address + 1 + direction;
  const double acceleration = row_product(m, d, row, d->qacc_warmstart), decay = slip_decay(contact, m->opt.timestep);
  const double now = acceleration + decay * (d->efc_vel[row] + contact.surfacevel[direction]);
  const double change = decay * m->opt.timestep * acceleration, before = now - change;
  return std::abs(std::abs(before) > std::abs(change) ? now : before);
}

// Make a contact's second tangent the first, whose friction has the contact's stiffness in MuJoCo.
void swap_tangents(const mjModel* m, mjData* d, mjContact& contact) {
  const double second[3] = {contact.frame[6], contact.frame[7], contact.frame[8]};
  align_tangents(m, d, contact, second);
  std::swap(contact.friction[0], contact.friction[1]);
  std::swap(contact.surfacevel[0], contact.surfacevel[1]);
  contact.surfacevel[1] *= -1;
}

}  // namespace

bool has_pyramid(const mjContact& contact) {
  const auto [less, more] = std::minmax(contact.friction[0], contact.friction[1]);
  return contact.dim >= 3 && less < more && more < kMaxRatio * less && more < kMaxFriction;
}

void shape_pyramids(const LawTables& laws, const mjModel* m, mjData* d) {
  if (laws.friction.empty() && !laws.crowd) return;
  for (int i = 0; i < d->ncon; ++i) {
    mjContact& contact = d->contact[i];
    if (contact.efc_address < 0 || !has_pyramid(contact)) continue;
    double* friction = contact.friction;
    double lack[2];
    for (int t = 0; t < 2; ++t) lack[t] = friction[t] * (predict_lack(m, d, contact, t) + kStill);
    if (lack[1] > lack[0]) {
      swap_tangents(m, d, contact);
      std::swap(lack[0], lack[1]);
    }
    friction[0] *= std::sqrt(1 + lack[1] / lack[0]);
    const double max_coefficient = std::max(friction[1], kMaxAspect * friction[0]);
    friction[1] = std::min(friction[1] * std::sqrt(1 + lack[0] / lack[1]), max_coefficient);
  }
}

}  // namespace trundle
