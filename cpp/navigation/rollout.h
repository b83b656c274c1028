#pragma once

#include <array>
#include <vector>

#include "costmap_cells.h"

namespace trundle {

using Triple = std::array<double, 3>;  // x, y [m], yaw [rad], or their rates

struct RolloutSettings {
  double sim_time;             // [s]
  double granularity;          // [m] between two points
  double angular_granularity;  // [rad] between two points
  double forward_point;        // [m] distance ahead of the center at which the alignment is measured
  Triple acceleration;         // [m/s²], [rad/s²]; not used unless `accelerates`
  bool accelerates;            // true: the velocity changes from the present one to the sample; false: it is the sample
  bool sums_costs;             // true: costs of obstacles add up along the trajectory; false: the highest counts
};

struct RolloutMaps {
  GridShape shape;
  std::array<double, 2> origin;  // [m], outer corner of the first cell
  double resolution;             // [m]
  const std::uint8_t* costs;
  const float* path;   // distance to the path, in cells
  const float* goal;   // distance to the end of the path
  const float* front;  // distance to a point beyond the end of the path
};

// Terms of a trajectory's score.
struct RolloutScore {
  double obstacles;  // cost of costmap_2d; negative: −1 collides, −2 leaves the map or enters unknown space
  double path, goal, front, alignment;  // distances at the end, in cells
  double steps;
};

// Poses of a trajectory, the first after one time step.
std::vector<Triple> roll_out(const RolloutSettings& settings, Triple pose, Triple velocity, const Triple& target);

using Polygon = std::vector<std::array<double, 2>>;

// Highest cost under the edges of a footprint and its center; negative as in `RolloutScore`.
double footprint_cost(const RolloutMaps& maps, const Polygon& footprint, const Triple& pose);

// Costs of one footprint, a polygon [m] around the robot's origin, or empty for its center alone.
//
// The costs of a round footprint do not depend on the yaw: the cost of each half cell is computed once, at its center.
class FootprintCosts {
 public:
  FootprintCosts(const RolloutMaps& maps, Polygon footprint);
  double at(const Triple& pose);
  [[nodiscard]] const RolloutMaps& maps() const { return maps_; }

 private:
  const RolloutMaps& maps_;
  Polygon footprint_;
  std::vector<float> known_;  // empty unless the footprint is round; NaN where not computed yet
};

// Score of one trajectory.
RolloutScore score_rollout(const RolloutSettings& settings, FootprintCosts& costs, const std::vector<Triple>& poses);

}  // namespace trundle
