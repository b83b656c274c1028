// Constraints on the pose of a link, and states that satisfy them.
#pragma once

#include <span>
#include <vector>

#include "collision_world.h"
#include "link_tree.h"
#include "state_space.h"

namespace trundle::planning {

enum class OrientationError { kNone, kEuler, kRotationVector };

// Bounds of a link's pose in a frame, as moveit_msgs/PositionConstraint and OrientationConstraint.
struct PoseConstraint {
  int link = 0;
  int frame = -1;              // link whose frame it is in; -1: the model frame
  Vec3 offset;                 // point of the link that is bounded, in its frame
  std::vector<Piece> regions;  // in the frame; the point is in one of them; none: anywhere
  OrientationError orientation = OrientationError::kNone;
  Rotation target;  // frame from link
  Vec3 tolerance;   // greatest angles [rad]: of rotations about x, then y, then z of the target, or of the axis's parts
};

// Sight from a sensor to a disc, as moveit_msgs/VisibilityConstraint.
struct VisibilityConstraint {
  int sensor_link = -1, target_link = -1;  // frames of the poses; -1: the model frame
  Rigid sensor, target;                    // the sensor looks along `view_axis` of its pose, the disc's normal is z
  int view_axis = 2;
  double radius = 0.0;           // [m]; 0: nothing to see
  int sides = 4;                 // of the cone that nothing may enter
  double max_view_angle = 0.0;   // [rad] between the disc's normal and the line of sight; 0: any
  double max_range_angle = 0.0;  // [rad] between the sensor's axis and the line of sight; 0: any
};

struct ConstraintSet {
  std::vector<PoseConstraint> poses;
  std::vector<VisibilityConstraint> visibilities;

  bool is_empty() const { return poses.empty() && visibilities.empty(); }
};

// Point of a convex region nearest to a point; the point itself if inside. Both in the region's frame.
Vec3 nearest_point(const ConvexShape& region, const Vec3& point);

// How far each of a constraint's numbers is beyond its bound, at some poses of links: 3 lengths [m] in the frame, then
// 3 angles [rad]; 0 inside. `gradient`, if wanted, gets a row per number and a column per variable.
struct Violation {
  std::vector<double> residuals;
  std::vector<double> gradient;
};
void measure(const PoseConstraint& constraint, const LinkTree& tree, const std::vector<Rigid>& poses,
             std::span<const int> variables, Violation& out, bool wants_gradient);

bool is_satisfied(const PoseConstraint& constraint, const std::vector<Rigid>& poses, double tolerance);
bool is_satisfied(const VisibilityConstraint& constraint, CollisionWorld& world, std::span<const double> state);

// Move a group's variables until the constraints hold: damped Gauss-Newton steps within the limits.
class Projection {
 public:
  Projection(const LinkTree& tree, const StateSpace& space, std::span<const int> variables)
      : tree_(tree), space_(space), variables_(variables.begin(), variables.end()) {}

  // Project `group`, with the other variables as in `state`, which is changed; false: not within some steps.
  bool project(std::span<const PoseConstraint> constraints, State& state, std::span<double> group, int max_steps);

  double tolerance = 1e-6;  // [m] and [rad]

 private:
  const LinkTree& tree_;
  const StateSpace& space_;
  std::vector<int> variables_;
  std::vector<Rigid> poses_;
  Violation violation_;
};

}  // namespace trundle::planning
