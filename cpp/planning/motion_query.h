// A whole query: search, check, shorten.
#pragma once

#include "path_simplifier.h"
#include "sampling_planner.h"

namespace trundle::planning {

struct MotionQuery {
  PlannerSettings planner;
  SimplifierSettings simplifier;
  bool simplifies = true;
  int max_repeats = 5;  // searches at a finer resolution, after a path that is not valid between what was checked
};

// Path from a valid start to a goal. One that a finer check refuses is searched again at a third of the resolution.
PlannedPath solve(Validity& validity, std::span<const double> start, GoalRegion& goals, const MotionQuery& query,
                  Random& random, const Deadline& deadline);

// A valid state near one that is not: random ones, at most `radius` away in each variable. Empty: none was found.
State find_valid_near(Validity& validity, std::span<const double> state, double radius, int attempts, Random& random);

}  // namespace trundle::planning
