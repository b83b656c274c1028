// Likelihood of a laser scan at a pose in a known map: the models of Thrun, Burgard and Fox, "Probabilistic Robotics"
// (2005), chapter 6, combined over the beams as amcl does.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "occupancy_map.h"
#include "particle.h"

namespace trundle::navigation {

enum class LaserKind { kBeam, kLikelihoodField, kLikelihoodFieldProb };

struct LaserOptions {
  LaserKind kind = LaserKind::kLikelihoodField;
  int max_beams = 30;
  double z_hit = 0.95, z_short = 0.1, z_max = 0.05, z_rand = 0.05;
  double sigma_hit = 0.2;     // [m]
  double lambda_short = 0.1;  // [1/m]
  double max_distance = 2.0;  // laser_likelihood_max_dist [m]
  bool do_beamskip = false;
  double beam_skip_distance = 0.5;  // [m]
  double beam_skip_threshold = 0.3, beam_skip_error_threshold = 0.9;
};

struct LaserScan {
  double x = 0.0, y = 0.0;               // position of the laser in the robot's frame [m]
  double range_max = 0.0;                // [m]; longer ranges hit nothing
  std::vector<double> ranges, bearings;  // [m], [rad] in the robot's frame
};

struct Agreement {
  bool has_converged = false;  // all are close together: beams that most of them do not explain may be skipped
  bool is_together = false;    // most are in one place
  bool is_close = false;       // most are within a step or two
};

class LaserModel {
 public:
  LaserModel(const LaserOptions& options, std::shared_ptr<const OccupancyMap> map);

  // Multiplies the weights by the likelihoods up to a common factor, and returns the logarithm of this factor.
  //
  // Beams of which the map tells nothing are left out if the particles are together: a pose whose beams end at the last
  // known piece of a wall would seem likelier than one that has passed it. The factor takes all beams to be like those
  // that are counted; without any, no weight changes, and there is no factor.
  std::optional<double> weigh(std::vector<Particle>& particles, const LaserScan& scan, const Agreement& agreement);

  // Pose near a prior one from which the ends of all known beams are nearest to what the map shows. The prior one
  // itself with the beam model, which has no distances.
  PlanarPose align(const PlanarPose& prior, const LaserScan& scan) const;

  // True if a scan's beams are multiplied; the other models add them.
  bool is_sharp() const { return options_.kind == LaserKind::kLikelihoodFieldProb; }

 private:
  struct Beams;
  struct Point {
    double x, y;
  };

  Beams used_beams(const LaserScan& scan) const;
  void fill_table(double range_max);
  void weigh_by_rays(std::vector<Particle>& particles, const LaserScan& scan) const;
  double weigh_by_table(std::vector<Particle>& particles, const Beams& beams, double share,
                        const std::vector<char>& is_used) const;
  void keep_known(const std::vector<Particle>& particles, const LaserScan& scan, double share, Beams& beams) const;
  PlanarPose align_once(const PlanarPose& pose, const PlanarPose& prior, const std::vector<Point>& ends) const;
  bool is_known(const PlanarPose& laser, double range, double bearing) const;
  std::vector<char> agreed_beams(const std::vector<Particle>& particles, const Beams& beams) const;

  LaserOptions options_;
  std::shared_ptr<const OccupancyMap> map_;
  std::vector<float> distances_;  // [m]
  std::vector<float> table_;      // a beam's term for each cell, and a border of one cell
  double table_range_max_ = -1.0;
};

}  // namespace trundle::navigation
