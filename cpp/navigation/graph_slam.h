// Mapping by a graph of poses: each scan is matched with those before it and with older ones nearby, and loops are
// closed where chains of older scans match. The candidates are chosen as by Konolige et al., "Efficient Sparse Pose
// Adjustment for 2D Mapping" (2010), in Karto.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "cell_counts.h"
#include "correlative_matcher.h"
#include "planar_pose.h"
#include "pose_graph.h"
#include "range_scan.h"

namespace trundle::navigation {

struct GraphOptions {
  double resolution = 0.05;                          // of the map [m]
  double least_distance = 0.2, least_angle = 0.175;  // between used scans [m], [rad]
  double least_time = 0.0;                           // [s]
  double longest_time = 3600.0;                      // after which a scan is used without motion [s]
  bool matches_scans = true;
  bool matches_all = false;        // scans between the used ones, too: without odometry
  bool uses_center = true;         // distances between scans are those of their centers, not of the robot
  int running_scans = 70;          // scans before that a scan is matched with
  double running_distance = 20.0;  // of their poses [m]
  double link_distance = 10.0, link_response = 0.8;  // of scans nearby [m]
  bool closes_loops = true;
  double loop_distance = 4.0;   // [m]
  int loop_chain = 10;          // least number of scans
  double loop_deviation = 0.4;  // highest of a match [m]
  double loop_response_coarse = 0.8, loop_response_fine = 0.8;
  double window_resolution = 0.01, window_smear = 0.03;  // [m]
  SearchOptions search;
  double loop_window_resolution = 0.05, loop_window_smear = 0.03;  // [m]
  SearchOptions loop_search;
  double linear_noise = 0.1, angular_noise = 0.1;                  // of the odometry, as parts of the motion
  double turn_per_distance = 0.05;                                 // and of the heading [rad / m]
  double still_linear_noise = 0.005, still_angular_noise = 0.003;  // and without motion [m], [rad]
  bool extends_map = true;  // false: scans are matched with the map, and forgotten
};

class GraphSlam {
 public:
  explicit GraphSlam(const GraphOptions& options);

  // Moves the robot and matches a scan; true if it became a node, after enough motion or time.
  //
  // motion: of the robot since the last call, in its frame then; time_s: stamp of the scan.
  bool process(const PlanarPose& motion, double time_s, RangeScan scan);

  // Pose of the robot in the map at the last scan.
  const PlanarPose& pose() const { return pose_; }
  // What the graph's optimizations moved the robot by: map_from_local, where the scans alone would have left it.
  const PlanarPose& correction() const { return correction_; }
  // Puts the robot somewhere; the next scan is searched for in the loop's window.
  void set_pose(const PlanarPose& pose);
  // Covariance of the last match, with the odometry: xx, xy, yy, xt, yt, tt [m], [rad].
  const std::array<double, 6>& covariance() const { return covariance_; }
  // Mean value at the last scan's hits, 0 to 1.
  double response() const { return response_; }
  int loops() const { return loops_; }
  // Loops that would have bent the graph more than its uncertainty allows.
  int refused_loops() const { return refused_loops_; }

  const PoseGraph& graph() const { return graph_; }
  const std::vector<RangeScan>& scans() const { return scans_; }
  // Goes on from a graph with a scan for each of its nodes.
  void restore(PoseGraph graph, std::vector<RangeScan> scans);

  SeenCells seen();
  std::vector<std::int8_t> draw(const MapFrame& frame);

 private:
  using Chain = std::vector<int>;  // numbers of nodes
  struct Motion {
    double distance = 0.0, angle = 0.0;  // [m], [rad]
  };

  Point place(int node) const;
  bool is_due(double time_s) const;
  Chain running() const;
  Chain nearest(Chain chain) const;
  ScoreWindow window(const Chain& chain, const PlanarPose& viewpoint, double half_width, double resolution,
                     double smear) const;
  void match(const RangeScan& scan);
  void find(const RangeScan& scan);
  std::array<double, 6> odometry_information(const Motion& motion) const;
  void add_node(RangeScan scan);
  std::vector<Chain> chains(const std::vector<bool>& is_candidate) const;
  std::vector<bool> linked_nearby() const;
  void link_nearby(const std::vector<bool>& is_linked);
  void close_loop(const std::vector<bool>& is_linked);
  bool accept_loop(const Constraint& constraint);
  Constraint constraint_to(const Chain& chain, const ScanMatch& match) const;
  void optimize();
  void move(const PlanarPose& last);
  void count_new();

  GraphOptions options_;
  PoseGraph graph_;
  std::vector<RangeScan> scans_;
  std::vector<Point> centers_;   // on the robot
  PlanarPose pose_, used_pose_;  // at the last scan, and at the last one used
  PlanarPose correction_;
  Motion since_match_, since_node_;
  double last_time_s_ = -std::numeric_limits<double>::infinity();
  std::array<double, 6> covariance_{}, match_information_{};
  double response_ = 0.0;
  bool is_lost_ = false;  // the next scan is searched for widely
  int loops_ = 0, refused_loops_ = 0, pending_links_ = 0;
  CellCounts counts_;
  std::vector<PlanarPose> counted_;  // of the nodes in counts_
};

}  // namespace trundle::navigation
