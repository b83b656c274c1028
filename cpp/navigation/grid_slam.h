// Grid mapping with a Rao-Blackwellized particle filter: as in Grisetti, Stachniss and Burgard, "Improved Techniques
// for Grid Mapping with Rao-Blackwellized Particle Filters" (2007), with gmapping's parameters.
#pragma once

#include <cstdint>
#include <vector>

#include "cell_counts.h"
#include "planar_pose.h"
#include "random.h"
#include "scan_matcher.h"
#include "seen_places.h"

namespace trundle::navigation {

struct SlamOptions {
  MatchOptions match;
  double delta = 0.05;                         // size of a cell [m]
  double max_range = 8.0, usable_range = 8.0;  // maxRange, maxUrange [m]
  double minimum_score = 0.0;
  double likelihood_gain = 3.0;                       // ogain
  double srr = 0.1, srt = 0.2, str = 0.1, stt = 0.2;  // noise of the odometry
  double linear_update = 1.0, angular_update = 0.5;   // [m], [rad]
  double temporal_update = -1.0;                      // [s]; negative: never
  double resample_threshold = 0.5;
  int particles = 30;
};

class GridSlam {
 public:
  // bearings: of a scan's beams in the laser's frame [rad]; pose: of the laser in the map at the first scan.
  GridSlam(const SlamOptions& options, std::vector<double> bearings, const PlanarPose& pose, std::uint64_t seed);

  // Moves the particles; true if the scan was used, after enough motion or time.
  //
  // odometry: pose of the laser in the odometry's frame; ranges: [m], as many as bearings.
  bool process(const PlanarPose& odometry, double time_s, const std::vector<double>& ranges);

  // Pose of the laser in the map, of the best particle.
  PlanarPose pose() const { return particles_[best()].pose; }
  // Entropy of the weights.
  double entropy() const;
  // Share of particles that kept their odometry at the last scan, as its match was below minimumScore.
  double unmatched_share() const { return unmatched_share_; }
  // Cells that the best particle's trajectory saw.
  SeenCells seen();
  // Map of the best particle's trajectory, row by row from below: -1 unknown, 0 free, 100 occupied.
  std::vector<std::int8_t> draw(const MapFrame& frame);

 private:
  struct Particle {
    PlanarPose pose;
    PlanarPose expected;  // by the odometry since the last scan, without noise
    HitMap map;
    double log_weight = 0.0;  // since the last resampling
    int node = -1;            // of its trajectory
  };
  struct Node {  // a pose at which a scan was used
    PlanarPose pose;
    int parent, scan;
  };

  std::size_t best() const;
  std::vector<double> weights() const;
  void drift(Particle& particle, const PlanarPose& motion);
  void match();
  void resample_if_needed();
  void register_scan();
  bool has_end(float range) const;
  std::vector<BeamEnd> beam_ends() const;
  std::vector<BeamEnd> comparable_ends(std::size_t& count) const;
  void count(const Node& node);
  void count_new();

  SlamOptions options_;
  std::vector<double> bearings_;
  SeenPlaces places_;
  ScanMatcher matcher_;
  Random random_;
  std::vector<Particle> particles_;
  std::vector<Node> nodes_;
  std::vector<std::vector<float>> scans_;
  PlanarPose odometry_;
  double driven_ = 0.0, turned_ = 0.0, last_time_s_ = 0.0;  // since the last scan used
  bool has_started_ = false;
  double unmatched_share_ = 0.0;
  CellCounts counts_;  // along the trajectory that ends in counted_node_
  int counted_node_ = -1;
};

}  // namespace trundle::navigation
