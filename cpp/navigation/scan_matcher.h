// Pose of a scan in a map of hits, by hill climbing, and its likelihood: as in Grisetti, Stachniss and Burgard,
// "Improved Techniques for Grid Mapping with Rao-Blackwellized Particle Filters" (2007), with gmapping's parameters.
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

// A beam's end in the laser's frame [m], and a point shortly before the end, which must be free.
struct BeamEnd {
  double x, y, before_x, before_y;
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

  Match optimize(const HitMap& map, const PlanarPose& start, const std::vector<BeamEnd>& beams) const;
  double log_likelihood(const HitMap& map, const PlanarPose& pose, const std::vector<BeamEnd>& beams) const;

 private:
  double score(const HitMap& map, const PlanarPose& pose, const std::vector<BeamEnd>& beams) const;

  MatchOptions options_;
};

}  // namespace trundle::navigation
