// Poses and what was measured between them, optimized by Levenberg-Marquardt steps: as in Grisetti, Kümmerle, Stachniss
// and Burgard, "A Tutorial on Graph-Based SLAM" (2010).
#pragma once

#include <array>
#include <vector>

#include "planar_pose.h"

namespace trundle::navigation {

struct Constraint {
  int from, to;                       // numbers of the nodes
  PlanarPose motion;                  // from_from_to
  std::array<double, 6> information;  // xx, xy, yy, xt, yt, tt: inverse covariance in the frame of `from`
};

struct PoseGraph {
  std::vector<PlanarPose> poses;  // of the nodes; the first stays where it is
  std::vector<Constraint> constraints;

  // Sum of the squared errors of all constraints, by their information.
  double error() const;

  // Moves the poses to where the error is least; returns it.
  double optimize();
};

// Symmetric matrix of x, y and yaw, with its axes turned by an angle [rad].
std::array<double, 6> turned(const std::array<double, 6>& matrix, double angle);

}  // namespace trundle::navigation
