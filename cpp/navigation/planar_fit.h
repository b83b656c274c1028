// One Gauss-Newton step of a pose toward surfaces, held by a prior pose where these tell nothing.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "planar_pose.h"
#include "symmetric_solve.h"

namespace trundle::navigation {

class PlanarFit {
 public:
  // Weight of the prior pose: that of so many points of a wall across the way, or at 1 m beside the robot. Where a scan
  // tells nothing, as along a corridor, it decides; elsewhere many more points do.
  static constexpr double kPriorPoints = 5.0;

  PlanarFit(const PlanarPose& pose, const PlanarPose& prior) : pose_(pose) {
    right_ = {kPriorPoints * (prior.x - pose.x), kPriorPoints * (prior.y - pose.y),
              kPriorPoints * angle_difference(prior.yaw, pose.yaw)};
  }

  // Adds a point that is to move along a direction of unit length.
  //
  // arm: way of the point along the direction by a turn of the pose [m/rad]; gap: the way that it is to move [m].
  void add(double direction_x, double direction_y, double arm, double gap, double weight) {
    const std::array<double, 3> row{direction_x, direction_y, arm};
    const std::array<double, 6> product{row[0] * row[0], row[0] * row[1], row[1] * row[1],
                                        row[0] * row[2], row[1] * row[2], row[2] * row[2]};
    for (std::size_t i = 0; i < product.size(); ++i) system_[i] += weight * product[i];
    for (std::size_t i = 0; i < row.size(); ++i) right_[i] += weight * gap * row[i];
  }

  // The pose after the step.
  PlanarPose moved() const {
    const std::array<double, 3> step = symmetric_product(symmetric_inverse(system_), right_);
    if (!std::isfinite(step[0] + step[1] + step[2])) return pose_;
    return {pose_.x + step[0], pose_.y + step[1], normalized_angle(pose_.yaw + step[2])};
  }

 private:
  PlanarPose pose_;
  std::array<double, 6> system_{kPriorPoints, 0.0, kPriorPoints, 0.0, 0.0, kPriorPoints};
  std::array<double, 3> right_;
};

}  // namespace trundle::navigation
