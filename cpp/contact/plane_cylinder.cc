#include "plane_cylinder.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "contact_geometry.h"

namespace trundle {

namespace {

constexpr double kMinTilt = 1e-7;  // [rad] below which the lowest point's direction is rounding noise
constexpr int kContacts = 3;

std::atomic<mjfCollision> original = nullptr;

// Three points of the rim, fixed to the cylinder.
int collide(const mjModel* m, mjData* d, mjPreContact* contacts, int plane, int cylinder, mjtNum margin) {
  const double *from_plane = d->geom_xmat + 9 * plane, *from_cylinder = d->geom_xmat + 9 * cylinder;
  const double normal[3] = {from_plane[2], from_plane[5], from_plane[8]};
  const double axis[3] = {from_cylinder[2], from_cylinder[5], from_cylinder[8]};
  double across[3];
  cross(across, normal, axis);
  if (dot(across, across) > kMinTilt * kMinTilt) return original.load()(m, d, contacts, plane, cylinder, margin);
  const double radius = m->geom_size[3 * cylinder];
  const double down = m->geom_size[3 * cylinder + 1] * (dot(normal, axis) > 0 ? -1 : 1);
  int count = 0;
  for (int i = 0; i < kContacts; ++i) {
    const double angle = 2 * mjPI * i / kContacts;
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    double point[3], from_centre[3];
    for (int j = 0; j < 3; ++j) {
      const double* row = from_cylinder + 3 * j;
      point[j] = d->geom_xpos[3 * cylinder + j] + row[0] * x + row[1] * y + row[2] * down;
      from_centre[j] = point[j] - d->geom_xpos[3 * plane + j];
    }
    const double distance = dot(from_centre, normal);
    if (distance > margin) continue;
    mjPreContact& contact = contacts[count++];
    contact.dist = distance;
    for (int j = 0; j < 3; ++j) contact.pos[j] = point[j] - normal[j] * distance / 2;
    std::copy(normal, normal + 3, contact.normal);
    std::fill(contact.tangent, contact.tangent + 3, 0.0);
  }
  return count;
}

}  // namespace

void install_plane_cylinder(mjfCollision table[mjNGEOMTYPES][mjNGEOMTYPES]) {
  mjfCollision& entry = table[mjGEOM_PLANE][mjGEOM_CYLINDER];
  if (entry == collide) return;
  original = entry;
  entry = collide;
}

}  // namespace trundle
