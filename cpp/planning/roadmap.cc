// PRM and PRM*: a graph of valid states, whose edges are checked when a shortest way uses them.
#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

#include "sampling_planner.h"

namespace trundle::planning {

namespace {

constexpr int kBatch = 60;  // samples between searches
constexpr std::size_t kMaxStates = 6000;

enum class EdgeState : std::uint8_t { kUnknown, kValid, kInvalid };

class Roadmap {
 public:
  Roadmap(Validity& validity, GoalRegion& goals, const PlannerSettings& settings, Random& random)
      : validity_(validity), space_(validity.space()), goals_(goals), settings_(settings), random_(random) {}

  PlannedPath solve(std::span<const double> start, const Deadline& deadline) {
    PlannedPath found;
    add(start, false);
    const bool improves = settings_.algorithm == Algorithm::kPrmStar;
    State sample(start.size());
    while (!deadline.is_over() && found.iterations < settings_.max_iterations && states_.size() < kMaxStates) {
      ++found.iterations;
      for (int i = 0; i < settings_.max_goals && goal_count_ < settings_.max_goals; ++i)
        if (goals_.sample(validity_, random_, sample)) add(sample, true);
      if (goal_count_ == 0) {
        if (goals_.attempts > 2000) break;
        continue;
      }
      for (int i = 0; i < kBatch && !deadline.is_over(); ++i)
        if (sample_state(validity_, random_, sample) && validity_.is_valid(sample)) add(sample, false);
      while (!deadline.is_over()) {
        const std::vector<int> way = shortest();
        if (way.empty()) break;
        if (!check(way)) continue;
        found.states = join(way);
        break;
      }
      if (!found.states.empty() && !improves) break;
    }
    found.nodes = states_.size();
    found.goals = goal_count_;
    return found;
  }

 private:
  struct Edge {
    int to;
    double length;
    std::size_t number;
  };

  void add(std::span<const double> state, bool is_goal) {
    const int node = static_cast<int>(states_.size());
    const double count = static_cast<double>(node + 1);
    const double star = std::exp(1.0) * (1.0 + 1.0 / static_cast<double>(space_.size())) * std::log(count);
    const auto wanted = settings_.algorithm == Algorithm::kPrmStar ? static_cast<std::size_t>(std::ceil(star))
                                                                   : static_cast<std::size_t>(settings_.neighbors);
    std::vector<std::pair<double, int>> near;
    for (int i = 0; i < node; ++i) near.emplace_back(space_.distance(states_[static_cast<std::size_t>(i)], state), i);
    const std::size_t kept = std::min(near.size(), wanted);
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(kept), near.end());
    states_.emplace_back(state.begin(), state.end());
    is_goal_.push_back(is_goal);
    edges_.emplace_back();
    goal_count_ += is_goal;
    for (std::size_t k = 0; k < kept; ++k) {
      const auto [length, other] = near[k];
      edges_[static_cast<std::size_t>(node)].push_back({other, length, edge_states_.size()});
      edges_[static_cast<std::size_t>(other)].push_back({node, length, edge_states_.size()});
      edge_states_.push_back(EdgeState::kUnknown);
    }
  }

  // Nodes of the shortest way over edges that are not invalid, from the start to a goal (Dijkstra).
  std::vector<int> shortest() const {
    std::vector<double> costs(states_.size(), 1e300);
    std::vector<int> before(states_.size(), -1);
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue;
    queue.emplace(costs[0] = 0.0, 0);
    while (!queue.empty()) {
      const auto [cost, node] = queue.top();
      queue.pop();
      const auto at = static_cast<std::size_t>(node);
      if (cost > costs[at]) continue;
      if (is_goal_[at]) {
        std::vector<int> way;
        for (int i = node; i >= 0; i = before[static_cast<std::size_t>(i)]) way.push_back(i);
        return {way.rbegin(), way.rend()};
      }
      for (const Edge& edge : edges_[at]) {
        const auto to = static_cast<std::size_t>(edge.to);
        if (edge_states_[edge.number] == EdgeState::kInvalid || cost + edge.length >= costs[to]) continue;
        costs[to] = cost + edge.length;
        before[to] = node;
        queue.emplace(costs[to], edge.to);
      }
    }
    return {};
  }

  // Check the edges of a way; false: one is invalid.
  bool check(const std::vector<int>& way) {
    for (std::size_t i = 1; i < way.size(); ++i) {
      const auto from = static_cast<std::size_t>(way[i - 1]), to = static_cast<std::size_t>(way[i]);
      for (const Edge& edge : edges_[from]) {
        EdgeState& state = edge_states_[edge.number];
        if (edge.to != way[i] || state == EdgeState::kInvalid) continue;
        if (state == EdgeState::kUnknown)
          state = connect(from, to, edge.number) ? EdgeState::kValid : EdgeState::kInvalid;
        if (state == EdgeState::kInvalid) return false;
        break;
      }
    }
    return true;
  }

  bool connect(std::size_t from, std::size_t to, std::size_t edge) {
    if (!validity_.is_constrained()) return validity_.is_motion_valid(states_[from], states_[to], false);
    SearchTree tree(space_.size());
    tree.add(states_[from], -1);
    const Advance step = advance(validity_, tree, 0, states_[to], 1e30);
    if (step.has_reached) between_[{edge, from}] = tree.path_to(step.node);
    return step.has_reached;
  }

  std::vector<State> join(const std::vector<int>& way) const {
    std::vector<State> path{states_[static_cast<std::size_t>(way.front())]};
    for (std::size_t i = 1; i < way.size(); ++i) {
      const auto from = static_cast<std::size_t>(way[i - 1]), to = static_cast<std::size_t>(way[i]);
      const auto edge = std::find_if(edges_[from].begin(), edges_[from].end(), [&](const Edge& e) {
        return e.to == way[i] && edge_states_[e.number] == EdgeState::kValid;
      });
      if (const auto there = between_.find({edge->number, from}); there != between_.end())
        path.insert(path.end(), there->second.begin() + 1, there->second.end());
      else if (const auto back = between_.find({edge->number, to}); back != between_.end())
        path.insert(path.end(), back->second.rbegin() + 1, back->second.rend());
      else path.push_back(states_[to]);
    }
    return path;
  }

  Validity& validity_;
  const StateSpace& space_;
  GoalRegion& goals_;
  const PlannerSettings& settings_;
  Random& random_;
  std::vector<State> states_;
  std::vector<bool> is_goal_;
  std::vector<std::vector<Edge>> edges_;
  std::vector<EdgeState> edge_states_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<State>>
      between_;  // edge, its first node → projected states
  int goal_count_ = 0;
};

}  // namespace

PlannedPath build_roadmap(Validity& validity, std::span<const double> start, GoalRegion& goals,
                          const PlannerSettings& settings, Random& random, const Deadline& deadline) {
  return Roadmap(validity, goals, settings, random).solve(start, deadline);
}

}  // namespace trundle::planning
