// Motion of the particles by odometry: the sample models of Thrun, Burgard and Fox, "Probabilistic Robotics" (2005),
// table 5.6, with amcl's parameters.
#pragma once

#include <array>
#include <vector>

#include "particle.h"
#include "random.h"

namespace trundle::navigation {

// The plain models use the variances as standard deviations, as amcl always did, but at least a share of their square
// roots; the corrected models use the square roots.
enum class OdometryKind { kDiff, kOmni, kDiffCorrected, kOmniCorrected };

struct OdometryModel {
  OdometryKind kind = OdometryKind::kDiff;
  // odom_alpha1 … 5: noise of rotation by rotation, of rotation by translation, of translation by translation,
  // of translation by rotation, of sideways motion.
  std::array<double, 5> alphas{0.2, 0.2, 0.2, 0.2, 0.2};

  // Moves each particle as the odometry moved from one pose to another, with noise.
  void move(std::vector<Particle>& particles, const PlanarPose& from, const PlanarPose& to, Random& random) const;
};

}  // namespace trundle::navigation
