// RRT and RRT*: one tree from the start.
#include <algorithm>
#include <cmath>

#include "path_simplifier.h"
#include "sampling_planner.h"

namespace trundle::planning {

namespace {

constexpr int kGoalTries = 40;            // attempts to find the first goals
constexpr std::size_t kMaxNodes = 20000;  // of RRT*, so that it ends before long times do
constexpr int kMaxNeighbors = 40;

class SingleTree {
 public:
  SingleTree(Validity& validity, GoalRegion& goals, const PlannerSettings& settings, double range, Random& random)
      : validity_(validity),
        space_(validity.space()),
        goals_(goals),
        settings_(settings),
        range_(range),
        random_(random),
        tree_(space_.size()) {}

  PlannedPath solve(std::span<const double> start, const Deadline& deadline) {
    const bool is_star = settings_.algorithm == Algorithm::kRrtStar && !validity_.is_constrained();
    PlannedPath found;
    tree_.add(start, -1);
    costs_.push_back(0.0);
    State target(start.size());
    while (!deadline.is_over() && found.iterations < settings_.max_iterations) {
      ++found.iterations;
      if (goal_states_.empty() && !find_goals()) break;
      const bool seeks_goal = random_.uniform() < settings_.goal_bias;
      if (seeks_goal) target = goal_states_[random_.index(goal_states_.size())];
      else if (!sample_state(validity_, random_, target)) continue;
      if (is_star) {
        grow_star(target);
        if (tree_.size() >= kMaxNodes) break;
        continue;
      }
      const Advance step = advance(validity_, tree_, tree_.nearest(space_, target), target, range_);
      if (seeks_goal && step.has_reached) {
        found.states = tree_.path_to(step.node);
        break;
      }
    }
    if (is_star) found.states = best_path();
    found.nodes = tree_.size();
    found.goals = static_cast<int>(goal_states_.size());
    return found;
  }

 private:
  bool find_goals() {
    State goal(space_.size());
    for (int i = 0; i < kGoalTries * settings_.max_goals; ++i) {
      if (goals_.sample(validity_, random_, goal)) goal_states_.push_back(goal);
      if (static_cast<int>(goal_states_.size()) >= settings_.max_goals) break;
    }
    return !goal_states_.empty();
  }

  // Add a node below the neighbor with the cheapest way to it, and lead neighbors through it where that is cheaper.
  void grow_star(std::span<const double> target) {
    const int nearest = tree_.nearest(space_, target);
    const double away = space_.distance(tree_.state(nearest), target);
    if (away < 1e-9) return;
    State next(target.size());
    space_.interpolate(tree_.state(nearest), target, std::min(1.0, range_ / away), next);
    if (!validity_.is_valid(next)) return;
    const double count = static_cast<double>(tree_.size() + 1);
    const double radius = std::min(
        range_, 1.5 * space_.extent() * std::pow(std::log(count) / count, 1.0 / static_cast<double>(next.size())));
    std::vector<std::pair<double, int>> near;
    for (int i = 0; i < static_cast<int>(tree_.size()); ++i) {
      const double distance = space_.distance(tree_.state(i), next);
      if (distance <= radius || i == nearest) near.emplace_back(costs_[static_cast<std::size_t>(i)] + distance, i);
    }
    std::sort(near.begin(), near.end());
    if (near.size() > kMaxNeighbors) near.resize(kMaxNeighbors);
    int parent = -1;
    double cost = 0.0;
    for (const auto& [through, node] : near) {
      if (!validity_.is_motion_valid(tree_.state(node), next, false)) continue;
      parent = node;
      cost = through;
      break;
    }
    if (parent < 0) return;
    const int added = tree_.add(next, parent);
    costs_.push_back(cost);
    for (const auto& [through, node] : near) {
      const auto i = static_cast<std::size_t>(node);
      const double shorter = cost + space_.distance(next, tree_.state(node));
      if (node == parent || shorter >= costs_[i] - 1e-9) continue;
      if (!validity_.is_motion_valid(next, tree_.state(node), false)) continue;
      tree_.set_parent(node, added);
      lower_costs(node, costs_[i] - shorter);
    }
  }

  // The cost of a node and of all below it falls. A node may be below one that was added later.
  void lower_costs(int node, double by) {
    std::vector<int> pending{node};
    while (!pending.empty()) {
      const int at = pending.back();
      pending.pop_back();
      costs_[static_cast<std::size_t>(at)] -= by;
      for (int i = 1; i < static_cast<int>(tree_.size()); ++i)
        if (tree_.parent(i) == at) pending.push_back(i);
    }
  }

  std::vector<State> best_path() const {
    int best = -1;
    for (int i = 0; i < static_cast<int>(tree_.size()); ++i) {
      const bool is_goal = std::any_of(goal_states_.begin(), goal_states_.end(),
                                       [&](const State& goal) { return space_.distance(goal, tree_.state(i)) < 1e-6; });
      if (is_goal && (best < 0 || costs_[static_cast<std::size_t>(i)] < costs_[static_cast<std::size_t>(best)]))
        best = i;
    }
    return best < 0 ? std::vector<State>{} : tree_.path_to(best);
  }

  Validity& validity_;
  const StateSpace& space_;
  GoalRegion& goals_;
  const PlannerSettings& settings_;
  double range_;
  Random& random_;
  SearchTree tree_;
  std::vector<double> costs_;  // of the way from the start, of RRT*
  std::vector<State> goal_states_;
};

}  // namespace

PlannedPath grow_tree(Validity& validity, std::span<const double> start, GoalRegion& goals,
                      const PlannerSettings& settings, double range, Random& random, const Deadline& deadline) {
  return SingleTree(validity, goals, settings, range, random).solve(start, deadline);
}

}  // namespace trundle::planning
