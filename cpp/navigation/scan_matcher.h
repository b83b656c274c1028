// Pose of a scan in a map of hits, by hill climbing and Gauss-Newton steps, and its likelihood: as in Grisetti,
// Stachniss and Burgard, "Improved Techniques for Grid Mapping with Rao-Blackwellized Particle Filters" (2007), with
// gmapping's parameters.
#pragma once

#include <cstdint>
#include <vector>

#include "patch_map.h"
#include "planar_pose.h"

namespace trundle::navigation {

// Ends of the beams in one cell.
struct Hits {
  float x = 0.0f, y = 0.0f;  // sum of their offsets from the cell's corner [m]
  std::int32_t count = 0;
};

using HitMap = PatchMap<Hits>;

// A beam's end in the laser's frame [m], a point shortly before the end, which must be free, and the unit normal of the
// surface that was hit; zeros: unknown.
struct BeamEnd {
  double x, y, before_x, before_y, normal_x, normal_y;
};

struct MatchOptions {
  double sigma = 0.05;  // width of the score: a beam's end that is d [m] from a hit adds exp(-d² / sigma)
  int kernel_size = 1;  // neighbors searched for the nearest hit [cells]
  double linear_step = 0.05, angular_step = 0.05;  // lstep [m], astep [rad]
  int iterations = 5;                              // halvings of the steps
  double likelihood_sigma = 0.075;                 // lsigma: the same for the likelihood
  int skipped_beams = 0;                           // lskip: beams that the likelihood skips
};

struct Match {
  PlanarPose pose;
  double score = 0.0;  // at most the number of beams
};

class ScanMatcher {
 public:
  explicit ScanMatcher(const MatchOptions& options) : options_(options) {}

  // expected: pose by the odometry; drawn: a pose near it, by the odometry's noise. The score is that before the
  // Gauss-Newton steps.
  Match optimize(const HitMap& map, const PlanarPose& expected, const PlanarPose& drawn,
                 const std::vector<BeamEnd>& beams) const;
  double log_likelihood(const HitMap& map, const PlanarPose& pose, const std::vector<BeamEnd>& beams) const;

 private:
  double score(const HitMap& map, const PlanarPose& pose, const std::vector<BeamEnd>& beams) const;
  Match climb(const HitMap& map, Match best, const std::vector<BeamEnd>& beams) const;
  PlanarPose align(const HitMap& map, PlanarPose pose, const PlanarPose& prior,
                   const std::vector<BeamEnd>& beams) const;

  MatchOptions options_;
};

}  // namespace trundle::navigation
