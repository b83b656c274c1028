// Adaptive Monte Carlo localization: KLD sampling (Fox, 2003) and augmented MCL, as in Thrun, Burgard and Fox,
// "Probabilistic Robotics" (2005), tables 8.3 and 8.4.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "laser_model.h"
#include "occupancy_map.h"
#include "odometry_model.h"
#include "particle.h"
#include "random.h"

namespace trundle::navigation {

struct FilterOptions {
  int min_particles = 100, max_particles = 5000;
  double kld_err = 0.01, kld_z = 0.99;
  double alpha_slow = 0.001, alpha_fast = 0.1;  // recovery_alpha_slow, recovery_alpha_fast
  bool selective_resampling = false;
};

struct Estimate {
  PlanarPose pose;                     // mean of the heaviest cluster
  std::array<double, 9> covariance{};  // covariance of all particles: x, y, yaw, row by row
};

class ParticleFilter {
 public:
  ParticleFilter(const FilterOptions& options, std::shared_ptr<const OccupancyMap> map, std::uint64_t seed);

  void set_options(const FilterOptions& options) { options_ = options; }

  // Draws max_particles from a normal distribution; covariance: matrix of x, y, yaw, row by row.
  void spread(const PlanarPose& mean, const std::array<double, 9>& covariance);
  // Draws more than max_particles over all free cells; the first scan reduces them.
  void spread_over_map();

  void move(const OdometryModel& model, const PlanarPose& from, const PlanarPose& to) {
    model.move(particles_, from, to, random_);
  }
  void weigh(LaserModel& model, const LaserScan& scan);
  // Draws as many particles as their spread requires; some of them anywhere, if the scans have become less likely.
  void resample();

  Estimate estimate() const;
  const std::vector<Particle>& particles() const { return particles_; }

 private:
  void sharpen(const std::vector<double>& before);
  void draw();
  PlanarPose random_pose();
  bool has_converged() const;
  bool has_agreed(double distance) const;

  FilterOptions options_;
  std::shared_ptr<const OccupancyMap> map_;
  std::vector<std::int32_t> free_cells_;
  Random random_;
  std::vector<Particle> particles_;
  double slow_average_ = 0.0, fast_average_ = 0.0;
};

}  // namespace trundle::navigation
