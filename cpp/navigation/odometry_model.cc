#include "odometry_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trundle::navigation {

namespace {

constexpr double kLeastShare = 0.2;  // share of the standard deviation; its square is nearly zero for short motions
constexpr double kMinTranslation = 0.01;   // [m]; below, the direction of the motion is noise
constexpr double kPivotTranslation = 0.1;  // [m]; below, a direction that no arc of the turn has is a slip

double square(double value) { return value * value; }

// Magnitude of a rotation, for its noise; driving backwards is no half turn.
double turn(double angle) {
  return std::min(std::abs(normalized_angle(angle)), std::abs(angle_difference(angle, std::numbers::pi)));
}

}  // namespace

void OdometryModel::move(std::vector<Particle>& particles, const PlanarPose& from, const PlanarPose& to,
                         Random& random) const {
  const auto [a1, a2, a3, a4, a5] = alphas;
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double translation = std::hypot(dx, dy);
  const double rotation = angle_difference(to.yaw, from.yaw);
  const bool is_corrected = kind == OdometryKind::kDiffCorrected || kind == OdometryKind::kOmniCorrected;
  const auto sigma = [is_corrected](double variance) {
    const double root = std::sqrt(variance);
    return is_corrected ? root : std::max(variance, kLeastShare * root);
  };
  if (kind == OdometryKind::kOmni || kind == OdometryKind::kOmniCorrected) {
    const double bearing = angle_difference(std::atan2(dy, dx), from.yaw);
    const double forward_sigma = sigma(a3 * square(translation) + a1 * square(rotation));
    const double turn_sigma = sigma(a4 * square(rotation) + a2 * square(translation));
    const double sideways_sigma = sigma(a1 * square(rotation) + a5 * square(translation));
    for (auto& [pose, weight] : particles) {
      const double c = std::cos(bearing + pose.yaw), s = std::sin(bearing + pose.yaw);
      const double forward = translation + random.gaussian(forward_sigma);
      const double turned = rotation + random.gaussian(turn_sigma);
      const double sideways = random.gaussian(sideways_sigma);
      pose = {pose.x + forward * c + sideways * s, pose.y + forward * s - sideways * c,
              normalized_angle(pose.yaw + turned)};
    }
    return;
  }
  const double first = translation < kMinTranslation ? 0.0 : angle_difference(std::atan2(dy, dx), from.yaw);
  const double second = angle_difference(rotation, first);
  double first_square = square(turn(first)), second_square = square(turn(second));
  if (translation < kPivotTranslation && first_square + second_square > square(rotation)) {
    first_square = 0.0;
    second_square = square(rotation);
  }
  const double first_sigma = sigma(a1 * first_square + a2 * square(translation));
  const double forward_sigma = sigma(a3 * square(translation) + a4 * first_square + a4 * second_square);
  const double second_sigma = sigma(a1 * second_square + a2 * square(translation));
  for (auto& [pose, weight] : particles) {
    const double heading = pose.yaw + first - random.gaussian(first_sigma);
    const double forward = translation - random.gaussian(forward_sigma);
    pose = {pose.x + forward * std::cos(heading), pose.y + forward * std::sin(heading),
            normalized_angle(heading + second - random.gaussian(second_sigma))};
  }
}

}  // namespace trundle::navigation
