#include "contact_geometry.h"

#include <algorithm>

namespace trundle {

namespace {

constexpr double kMinTangent = 1e-6;  // smallest tangential part of a valid direction

// Turn a contact's two tangential constraint rows and their velocities. MuJoCo derives the rest after its control
// callback.
void turn_rows(const mjModel* m, mjData* d, const mjContact& contact, double cosine, double sine) {
  if (contact.efc_address < 0) return;
  const int row = contact.efc_address + 1;
  const bool sparse = mujoco.mj_isSparse(m);
  double* first = d->efc_J + (sparse ? d->efc_J_rowadr[row] : row * m->nv);
  double* second = d->efc_J + (sparse ? d->efc_J_rowadr[row + 1] : (row + 1) * m->nv);
  const int count = sparse ? d->efc_J_rownnz[row] : m->nv;  // both rows have the same columns
  for (int i = 0; i < count; ++i) {
    const double before = first[i];
    first[i] = cosine * before + sine * second[i];
    second[i] = cosine * second[i] - sine * before;
  }
  double* speeds = d->efc_vel + row;
  const double before = speeds[0];
  speeds[0] = cosine * before + sine * speeds[1];
  speeds[1] = cosine * speeds[1] - sine * before;
}

}  // namespace

double approach_speed(const mjModel* m, const mjData* d, const mjContact& contact) {
  double speeds[2];
  for (int side = 0; side < 2; ++side) {
    const int body = m->geom_bodyid[contact.geom[side]];
    const double* velocity = d->cvel + 6 * body;  // velocity of the tree's centre of mass: angular, linear
    const double* centre = d->subtree_com + 3 * m->body_rootid[body];
    const double arm[3] = {contact.pos[0] - centre[0], contact.pos[1] - centre[1], contact.pos[2] - centre[2]};
    double turning[3];
    cross(turning, velocity, arm);
    const double at_contact[3] = {velocity[3] + turning[0], velocity[4] + turning[1], velocity[5] + turning[2]};
    speeds[side] = dot(contact.frame, at_contact);
  }
  return speeds[0] - speeds[1];
}

void ContactJacobian::find(const mjModel* m, const mjData* d, const mjContact& contact, double* rows, int count) {
  const int nv = m->nv, size = (count > 3 ? 6 : 3) * nv;
  first_.resize(size);
  second_.resize(size);
  for (int side = 0; side < 2; ++side) {
    std::vector<double>& motion = side == 0 ? first_ : second_;
    double* turning = count > 3 ? motion.data() + 3 * nv : nullptr;
    mujoco.mj_jac(m, d, motion.data(), turning, contact.pos, m->geom_bodyid[contact.geom[side]]);
  }
  for (int i = 0; i < size; ++i) second_[i] -= first_[i];
  for (int row = 0; row < count; ++row) {
    const double* axis = contact.frame + 3 * (row % 3);
    const double* motion = second_.data() + 3 * nv * (row / 3);
    for (int i = 0; i < nv; ++i)
      rows[row * nv + i] = axis[0] * motion[i] + axis[1] * motion[nv + i] + axis[2] * motion[2 * nv + i];
  }
}

double row_product(const mjModel* m, const mjData* d, int row, const double* vector) {
  double sum = 0;
  if (mujoco.mj_isSparse(m)) {
    const int first = d->efc_J_rowadr[row];
    for (int i = first; i < first + d->efc_J_rownnz[row]; ++i) sum += d->efc_J[i] * vector[d->efc_J_colind[i]];
  } else {
    for (int i = 0; i < m->nv; ++i) sum += d->efc_J[row * m->nv + i] * vector[i];
  }
  return sum;
}

bool align_tangents(const mjModel* m, mjData* d, mjContact& contact, const double along[3]) {
  double* frame = contact.frame;
  const double normal_part = dot(along, frame);
  double tangent[3] = {along[0] - normal_part * frame[0], along[1] - normal_part * frame[1],
                       along[2] - normal_part * frame[2]};
  const double length = std::sqrt(dot(tangent, tangent));
  if (!(length > kMinTangent * std::sqrt(dot(along, along)))) return false;
  for (double& component : tangent) component /= length;
  const double cosine = dot(tangent, frame + 3), sine = dot(tangent, frame + 6);
  if (sine == 0 && cosine > 0) return true;
  turn_rows(m, d, contact, cosine, sine);
  std::copy(tangent, tangent + 3, frame + 3);
  cross(frame + 6, frame, frame + 3);
  return true;
}

}  // namespace trundle
