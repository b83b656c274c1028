// Pose on the ground.
#pragma once

#include <cmath>
#include <numbers>

namespace trundle::navigation {

struct PlanarPose {
  double x = 0.0, y = 0.0;  // [m]
  double yaw = 0.0;         // [rad]
};

// Angle in [-pi, pi].
inline double normalized_angle(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

inline double angle_difference(double a, double b) { return normalized_angle(a - b); }

// a_from_c of a_from_b and b_from_c.
inline PlanarPose compose(const PlanarPose& a, const PlanarPose& b) {
  const double c = std::cos(a.yaw), s = std::sin(a.yaw);
  return {a.x + c * b.x - s * b.y, a.y + s * b.x + c * b.y, normalized_angle(a.yaw + b.yaw)};
}

inline PlanarPose inverse(const PlanarPose& a) {
  const double c = std::cos(a.yaw), s = std::sin(a.yaw);
  return {-c * a.x - s * a.y, s * a.x - c * a.y, normalized_angle(-a.yaw)};
}

}  // namespace trundle::navigation
