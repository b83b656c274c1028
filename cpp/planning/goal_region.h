// Goals of a plan as states: sampled from their constraints by projection.
#pragma once

#include <span>
#include <vector>

#include "pose_constraint.h"
#include "validity.h"

namespace trundle::planning {

struct JointBound {
  std::size_t variable = 0;  // of the group
  double lower = 0.0, center = 0.0, upper = 0.0;

  bool holds(double value, bool is_circle) const;
};

struct Goal {
  std::vector<JointBound> joints;
  ConstraintSet constraints;
};

class GoalRegion {
 public:
  GoalRegion(std::vector<Goal> goals, std::span<const double> start);

  // Look for one more state that satisfies a goal; false: this attempt found none.
  bool sample(Validity& validity, Random& random, std::span<double> out);
  bool is_satisfied(Validity& validity, std::span<const double> group) const;

  // What became of the attempts, for the sentence of a failure.
  long long attempts = 0, unreachable = 0, in_collision = 0;

 private:
  std::vector<Goal> goals_;
  State start_;
};

// A point of the region, evenly spread but for hulls.
Vec3 sample_point(const ConvexShape& region, Random& random);

}  // namespace trundle::planning
