// Tree of states that a sampling planner grows.
#pragma once

#include <span>
#include <vector>

#include "state_space.h"

namespace trundle::planning {

class SearchTree {
 public:
  explicit SearchTree(std::size_t dimension) : dimension_(dimension) {}

  int add(std::span<const double> state, int parent) {
    states_.insert(states_.end(), state.begin(), state.end());
    parents_.push_back(parent);
    return static_cast<int>(parents_.size()) - 1;
  }
  std::span<const double> state(int node) const {
    return {states_.data() + static_cast<std::size_t>(node) * dimension_, dimension_};
  }
  int parent(int node) const { return parents_[static_cast<std::size_t>(node)]; }
  void set_parent(int node, int parent) { parents_[static_cast<std::size_t>(node)] = parent; }
  std::size_t size() const { return parents_.size(); }

  int nearest(const StateSpace& space, std::span<const double> state) const {
    int best = 0;
    double smallest = 1e300;
    for (int i = 0; i < static_cast<int>(size()); ++i) {
      const double away = space.distance(this->state(i), state);
      if (away < smallest) {
        smallest = away;
        best = i;
      }
    }
    return best;
  }

  // States from the root to a node.
  std::vector<State> path_to(int node) const {
    std::vector<State> path;
    for (; node >= 0; node = parent(node)) path.emplace_back(state(node).begin(), state(node).end());
    return {path.rbegin(), path.rend()};
  }

 private:
  std::size_t dimension_;
  std::vector<double> states_;
  std::vector<int> parents_;
};

}  // namespace trundle::planning
