// Planners by samples: paths of a group from its start to a goal.
//
// RRT-Connect: Kuffner and LaValle 2000; along constraints as Berenson et al. 2009 (CBiRRT). RRT: LaValle 1998. RRT*:
// Karaman and Frazzoli 2011. PRM, with edges checked when they are used: Bohlin and Kavraki 2000.
#pragma once

#include <cstdint>
#include <vector>

#include "goal_region.h"
#include "search_tree.h"
#include "validity.h"

namespace trundle::planning {

enum class Algorithm { kRrtConnect, kRrt, kRrtStar, kPrm, kPrmStar };

struct PlannerSettings {
  Algorithm algorithm = Algorithm::kRrtConnect;
  double range = 0.0;       // greatest length of an edge; 0: a fifth of the space's extent
  double goal_bias = 0.05;  // how often RRT and RRT* try a goal
  int max_iterations = 1'000'000;
  int max_goals = 10;
  int neighbors = 10;  // of PRM
};

struct PlannedPath {
  std::vector<State> states;  // empty: none was found
  long long iterations = 0;
  std::size_t nodes = 0;
  int goals = 0;  // states found that satisfy a goal
};

// Path from the start, which is valid, to a goal; without goal states or at the deadline: none.
PlannedPath find_path(Validity& validity, std::span<const double> start, GoalRegion& goals,
                      const PlannerSettings& settings, Random& random, const Deadline& deadline);

// Nodes on the straight way from a node towards a state, as far as it is valid and at most `range`; along path
// constraints in small projected steps.
struct Advance {
  int node;
  bool has_reached, has_moved;
};
Advance advance(Validity& validity, SearchTree& tree, int from, std::span<const double> target, double range);

// A random state that keeps the path constraints.
bool sample_state(Validity& validity, Random& random, std::span<double> out);

// The planners of one tree, and of roadmaps.
PlannedPath grow_tree(Validity& validity, std::span<const double> start, GoalRegion& goals,
                      const PlannerSettings& settings, double range, Random& random, const Deadline& deadline);
PlannedPath build_roadmap(Validity& validity, std::span<const double> start, GoalRegion& goals,
                          const PlannerSettings& settings, Random& random, const Deadline& deadline);

}  // namespace trundle::planning
