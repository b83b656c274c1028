#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

/** Angles [rad]. */
namespace angles {

static inline double from_degrees(double degrees) { return degrees * M_PI / 180.0; }
static inline double to_degrees(double radians) { return radians * 180.0 / M_PI; }

/** Same angle in [0, 2π). */
static inline double normalize_angle_positive(double angle) {
  const double rest = std::fmod(angle, 2.0 * M_PI);
  return rest < 0.0 ? rest + 2.0 * M_PI : rest;
}
/** Same angle in (-π, π]. */
static inline double normalize_angle(double angle) {
  const double positive = normalize_angle_positive(angle);
  return positive > M_PI ? positive - 2.0 * M_PI : positive;
}
/** Rotation by which `from` becomes `to`, the shorter way. */
static inline double shortest_angular_distance(double from, double to) { return normalize_angle(to - from); }
/** Same rotation, the other way around. */
static inline double two_pi_complement(double angle) {
  const double rest = std::fmod(angle, 2.0 * M_PI);
  if (rest == 0.0) return 2.0 * M_PI;
  return rest > 0.0 ? rest - 2.0 * M_PI : rest + 2.0 * M_PI;
}

/** Shortest rotation that stays within limits of at most one turn; false if an angle is not within them. */
static inline bool shortest_angular_distance_with_limits(double from, double to, double left_limit, double right_limit,
                                                         double& shortest_angle) {
  const double span =
      right_limit >= left_limit ? right_limit - left_limit : normalize_angle_positive(right_limit - left_limit);
  const double at_from = normalize_angle_positive(from - left_limit);
  const double at_to = normalize_angle_positive(to - left_limit);
  shortest_angle = shortest_angular_distance(from, to);
  if (at_from > span || at_to > span) return false;
  shortest_angle = at_to - at_from;
  return true;
}

/** Shortest rotation to an angle, or to it a turn away, that stays within limits of any width, which are not angles on
 * a circle but positions of a joint; false, with the shortest of all, if none does. */
static inline bool shortest_angular_distance_with_large_limits(double from, double to, double left_limit,
                                                               double right_limit, double& shortest_angle) {
  shortest_angle = shortest_angular_distance(from, to);
  double other = two_pi_complement(shortest_angle);
  if (std::fabs(other) < std::fabs(shortest_angle)) std::swap(shortest_angle, other);
  for (const double way : {shortest_angle, other}) {
    if (from + way < left_limit || from + way > right_limit) continue;
    shortest_angle = way;
    return true;
  }
  return false;
}

}  // namespace angles
