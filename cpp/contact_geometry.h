// How two bodies move against each other where they touch, as a function of all speeds.
#pragma once

#include <cmath>
#include <vector>

#include "mujoco_api.h"

namespace trundle {

inline double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline double normalize(double v[3]) {
  const double length = std::sqrt(dot(v, v));
  if (length > 0) {
    for (int i = 0; i < 3; ++i) v[i] /= length;
  }
  return length;
}

inline void cross(double out[3], const double a[3], const double b[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

// How fast the two bodies of a contact come closer along its normal [m/s].
double approach_speed(const mjModel* m, const mjData* d, const mjContact& contact);

// Velocity of the second body against the first, along the normal out of the first and two tangents, and about it.
class ContactJacobian {
 public:
  // Write (count, nv) rows, three or four.
  void find(const mjModel* m, const mjData* d, const mjContact& contact, double* rows, int count = 3);

 private:
  std::vector<double> first_, second_;
};

// Lay a contact's first tangent along a direction, less what is normal, and its constraint with it; false where nothing
// is left of it.
bool align_tangents(const mjModel* m, mjData* d, mjContact& contact, const double along[3]);

}  // namespace trundle
