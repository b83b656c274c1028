#include "sampling_planner.h"

#include <algorithm>
#include <utility>

namespace trundle::planning {

namespace {

constexpr int kTriesPerGoal = 20;     // attempts to find a goal before the search starts
constexpr int kMaxTriesAlone = 2000;  // attempts while there is no goal yet, per iteration of other work
constexpr int kGoalPeriod = 20;       // iterations between attempts to find one more goal
constexpr double kConstrainedStep = 1.0;

class RrtConnect {
 public:
  RrtConnect(Validity& validity, GoalRegion& goals, const PlannerSettings& settings, double range, Random& random)
      : validity_(validity),
        goals_(goals),
        settings_(settings),
        range_(range),
        random_(random),
        from_start_(validity.space().size()),
        from_goal_(validity.space().size()) {}

  PlannedPath solve(std::span<const double> start, const Deadline& deadline) {
    PlannedPath found;
    from_start_.add(start, -1);
    State target(start.size());
    const int first = std::min(settings_.max_goals, 4);
    for (int i = 0; i < first * kTriesPerGoal && goal_count_ < first && !deadline.is_over(); ++i) add_goal();
    bool grows_start = true;
    while (!deadline.is_over() && found.iterations < settings_.max_iterations) {
      ++found.iterations;
      if (goal_count_ < settings_.max_goals && (goal_count_ == 0 || found.iterations % kGoalPeriod == 0)) add_goal();
      if (goal_count_ == 0) {
        if (goals_.attempts >= kMaxTriesAlone) break;
        continue;
      }
      if (!sample_state(validity_, random_, target)) continue;
      SearchTree& grown = grows_start ? from_start_ : from_goal_;
      SearchTree& other = grows_start ? from_goal_ : from_start_;
      const Advance a = advance(validity_, grown, grown.nearest(validity_.space(), target), target, range_);
      if (a.has_moved) {
        const State reached(grown.state(a.node).begin(), grown.state(a.node).end());
        int node = other.nearest(validity_.space(), reached);
        while (!deadline.is_over()) {
          const Advance b = advance(validity_, other, node, reached, range_);
          node = b.node;
          if (b.has_reached) {
            join(grows_start ? a.node : node, grows_start ? node : a.node, found);
            return found;
          }
          if (!b.has_moved) break;
        }
      }
      grows_start = !grows_start;
    }
    found.nodes = from_start_.size() + from_goal_.size();
    found.goals = goal_count_;
    return found;
  }

 private:
  void add_goal() {
    State goal(validity_.space().size());
    if (!goals_.sample(validity_, random_, goal)) return;
    from_goal_.add(goal, -1);
    ++goal_count_;
  }

  void join(int start_node, int goal_node, PlannedPath& found) const {
    found.states = from_start_.path_to(start_node);
    std::vector<State> rest = from_goal_.path_to(goal_node);
    std::reverse(rest.begin(), rest.end());
    found.states.insert(found.states.end(), rest.begin() + 1, rest.end());
    found.nodes = from_start_.size() + from_goal_.size();
    found.goals = goal_count_;
  }

  Validity& validity_;
  GoalRegion& goals_;
  const PlannerSettings& settings_;
  double range_;
  Random& random_;
  SearchTree from_start_, from_goal_;
  int goal_count_ = 0;
};

}  // namespace

bool sample_state(Validity& validity, Random& random, std::span<double> out) {
  validity.space().sample(random, out);
  return !validity.is_constrained() || validity.project(out);
}

Advance advance(Validity& validity, SearchTree& tree, int from, std::span<const double> target, double range) {
  const StateSpace& space = validity.space();
  const double away = space.distance(tree.state(from), target);
  if (away < 1e-9) return {from, true, false};
  State next(target.size());
  if (!validity.is_constrained()) {
    const bool is_near = away <= range;
    space.interpolate(tree.state(from), target, is_near ? 1.0 : range / away, next);
    if (!validity.is_valid(next) || !validity.is_motion_valid(tree.state(from), next, false))
      return {from, false, false};
    return {tree.add(next, from), is_near, true};
  }
  // Steps of the resolution, so that nothing between them needs a check.
  const double step = kConstrainedStep * validity.task().resolution;
  int node = from;
  double left = away, walked = 0.0;
  while (walked < range) {
    const State at(tree.state(node).begin(), tree.state(node).end());
    left = space.distance(at, target);
    if (left < 1e-9) return {node, true, node != from};
    space.interpolate(at, target, std::min(1.0, step / left), next);
    if (left > step && !validity.project(next)) break;
    const double moved = space.distance(at, next);
    if (moved > 2.0 * step || moved < 0.05 * std::min(step, left) || space.distance(next, target) >= left) break;
    if (!validity.is_valid(next)) break;
    node = tree.add(next, node);
    walked += moved;
  }
  return {node, space.distance(tree.state(node), target) < 1e-9, node != from};
}

PlannedPath find_path(Validity& validity, std::span<const double> start, GoalRegion& goals,
                      const PlannerSettings& settings, Random& random, const Deadline& deadline) {
  if (goals.is_satisfied(validity, start)) return {{State(start.begin(), start.end())}, 0, 1, 1};
  const double range = settings.range > 0.0 ? settings.range : 0.2 * validity.space().extent();
  switch (settings.algorithm) {
    case Algorithm::kRrt:
    case Algorithm::kRrtStar: return grow_tree(validity, start, goals, settings, range, random, deadline);
    case Algorithm::kPrm:
    case Algorithm::kPrmStar: return build_roadmap(validity, start, goals, settings, random, deadline);
    default: return RrtConnect(validity, goals, settings, range, random).solve(start, deadline);
  }
}

}  // namespace trundle::planning
