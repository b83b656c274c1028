// Poses of a robot and the times between them: the timed elastic band of Rösmann, Feiten, Wösch, Hoffmann and Bertram,
// "Trajectory modification considering dynamic constraints of autonomous robots", ROBOTIK 2012.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace trundle::navigation {

using BandPose = std::array<double, 3>;  // x, y [m], yaw [rad]

// Parameters of teb_local_planner by their names.
struct BandSettings {
  double dt_ref = 0.3, dt_hysteresis = 0.1;
  double max_vel_x = 0.4, max_vel_x_backwards = 0.2, max_vel_y = 0.0, max_vel_trans = 0.0, max_vel_theta = 0.3;
  double acc_lim_x = 0.5, acc_lim_y = 0.5, acc_lim_theta = 0.5;
  double min_turning_radius = 0.0;
  double min_obstacle_dist = 0.5, inflation_dist = 0.6;
  double obstacle_association_force_inclusion_factor = 1.5, obstacle_association_cutoff_factor = 5.0;
  double penalty_epsilon = 0.05, weight_adapt_factor = 2.0, obstacle_cost_exponent = 1.0;
  double weight_max_vel_x = 2.0, weight_max_vel_y = 2.0, weight_max_vel_theta = 1.0;
  double weight_acc_lim_x = 1.0, weight_acc_lim_y = 1.0, weight_acc_lim_theta = 1.0;
  double weight_kinematics_nh = 1000.0, weight_kinematics_forward_drive = 1.0, weight_kinematics_turning_radius = 1.0;
  double weight_optimaltime = 1.0, weight_shortest_path = 0.0, weight_viapoint = 1.0;
  double weight_obstacle = 50.0, weight_inflation = 0.1;
  int min_samples = 3, max_samples = 500, no_inner_iterations = 5, no_outer_iterations = 4;
  bool teb_autosize = true, exact_arc_length = false, free_goal_vel = false;
};

struct TimedBand {
  std::vector<BandPose> poses;
  std::vector<double> steps;  // [s], one fewer than poses

  // Times that a path takes at the greatest speeds.
  void set(std::vector<BandPose> path, const BandSettings& settings);

  // Begins at another pose, drops what lies behind it, and ends at another goal.
  void move_ends(const BandPose& start, const BandPose& goal);

  // Splits long steps and joins short ones, until all are near dt_ref.
  void resize(const BandSettings& settings);
};

[[nodiscard]] double angle_between(double from, double to);

}  // namespace trundle::navigation
