// Kinematics at contacts: relative velocity, Jacobian, tangents.
#pragma once

#include <cmath>
#include <vector>

#include "mujoco_api.h"

namespace trundle {

inline double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline double normalize(double v[3]) {
  const double length = std::sqrt(dot(v, v));
  if (length > 0)
    for (int i = 0; i < 3; ++i) v[i] /= length;
  return length;
}

inline void cross(double out[3], const double a[3], const double b[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

// Approach speed of a contact's bodies along its normal [m/s].
double approach_speed(const mjModel* m, const mjData* d, const mjContact& contact);

// Jacobian of the second body's velocity relative to the first: along the normal (out of the first), along two
// tangents, about the normal.
class ContactJacobian {
 public:
  // rows: (count, nv), count 3 or 4.
  void find(const mjModel* m, const mjData* d, const mjContact& contact, double* rows, int count = 3);

 private:
  std::vector<double> first_, second_;
};

// Product of a constraint row with a vector (nv).
double row_product(const mjModel* m, const mjData* d, int row, const double* vector);

// Turn a contact's first tangent, and its constraint rows, to a direction projected into the tangent plane; false if
// the projection vanishes.
bool align_tangents(const mjModel* m, mjData* d, mjContact& contact, const double along[3]);

}  // namespace trundle
