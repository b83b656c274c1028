#include "path_simplifier.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sampling_planner.h"

namespace trundle::planning {

namespace {

constexpr double kLeastGain = 0.01;  // of the length of a part, below which a shortcut is not worth its checks

bool can_go(Validity& validity, std::span<const double> a, std::span<const double> b) {
  return validity.is_motion_valid(a, b, false) && validity.is_motion_valid(a, b, true);
}

// Valid states from one state to another, without the first; empty: there is no direct way.
std::vector<State> direct_way(Validity& validity, const State& a, const State& b) {
  if (!validity.is_constrained()) return can_go(validity, a, b) ? std::vector<State>{b} : std::vector<State>{};
  SearchTree tree(a.size());
  tree.add(a, -1);
  const Advance advanced = advance(validity, tree, 0, b, 1e30);
  if (!advanced.has_reached) return {};
  std::vector<State> way = tree.path_to(advanced.node);
  way.erase(way.begin());
  return way;
}

class Simplifier {
 public:
  Simplifier(Validity& validity, std::vector<State>& path, Random& random, const Deadline& deadline)
      : validity_(validity), space_(validity.space()), path_(path), random_(random), deadline_(deadline) {}

  // Join two random points of the path by the direct way, if that is shorter.
  void shortcut(int attempts, int patience) {
    int in_vain = 0;
    for (int i = 0; i < attempts && in_vain < patience && path_.size() > 2 && !deadline_.is_over(); ++i) {
      ++in_vain;
      auto [first, a, last, b] = two_points();
      if (last <= first) continue;
      const double before = length_between(first, a, last, b);
      if (space_.distance(a, b) >= before * (1.0 - kLeastGain)) continue;
      std::vector<State> way = direct_way(validity_, a, b);
      if (way.empty() || way_length(a, way) >= before - 1e-6) continue;
      in_vain = 0;
      way.insert(way.begin(), a);
      replace(first, last, std::move(way));
    }
  }

  // Leave out waypoints between which there is a direct way, the longest part first.
  void drop_waypoints() {
    if (validity_.is_constrained()) return;
    for (std::size_t i = 0; i + 2 < path_.size() && !deadline_.is_over();) {
      const bool is_free = can_go(validity_, path_[i], path_[i + 2]);
      if (is_free) path_.erase(path_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      else ++i;
    }
  }

  // The same for one variable alone: the others go on as they did.
  void shortcut_variable(int attempts, int patience) {
    if (validity_.is_constrained() || space_.has_quaternions()) return;
    int in_vain = 0;
    for (int i = 0; i < attempts && in_vain < patience && path_.size() > 2 && !deadline_.is_over(); ++i) {
      ++in_vain;
      auto [first, a, last, b] = two_points();
      const std::size_t k = random_.index(a.size());
      if (last <= first || space_.dimensions()[k].is_circle) continue;
      std::vector<State> way{a};
      for (std::size_t node = first + 1; node <= last; ++node) way.push_back(path_[node]);
      way.push_back(b);
      double total = 0.0;
      std::vector<double> at{0.0};
      for (std::size_t j = 1; j < way.size(); ++j) at.push_back(total += space_.distance(way[j - 1], way[j]));
      if (total < 1e-9) continue;
      const double before = total;
      for (std::size_t j = 1; j + 1 < way.size(); ++j) way[j][k] = a[k] + at[j] / total * (b[k] - a[k]);
      double after = 0.0;
      for (std::size_t j = 1; j < way.size(); ++j) after += space_.distance(way[j - 1], way[j]);
      if (after >= before * (1.0 - 0.1 * kLeastGain) || !is_way_valid(way)) continue;
      in_vain = 0;
      replace(first, last, std::move(way));
    }
  }

  // Replace each corner by two that are at most `cut` before and after it, where that is valid.
  void cut_corners(double cut) {
    if (validity_.is_constrained() || path_.size() < 3) return;
    std::vector<State> smooth{path_.front()};
    State before(space_.size()), after(space_.size());
    for (std::size_t i = 1; i + 1 < path_.size(); ++i) {
      const double in = space_.distance(path_[i - 1], path_[i]), out = space_.distance(path_[i], path_[i + 1]);
      space_.interpolate(path_[i], path_[i - 1], std::min(0.4, cut / std::max(in, 1e-9)), before);
      space_.interpolate(path_[i], path_[i + 1], std::min(0.4, cut / std::max(out, 1e-9)), after);
      if (!deadline_.is_over() && can_go(validity_, before, after)) {
        smooth.push_back(before);
        smooth.push_back(after);
      } else {
        smooth.push_back(path_[i]);
      }
    }
    smooth.push_back(path_.back());
    path_ = std::move(smooth);
  }

 private:
  struct TwoPoints {
    std::size_t first;  // part of the path with the first point
    State a;
    std::size_t last;
    State b;
  };

  TwoPoints two_points() {
    std::vector<double> ends{0.0};
    for (std::size_t i = 1; i < path_.size(); ++i)
      ends.push_back(ends.back() + space_.distance(path_[i - 1], path_[i]));
    double s = random_.uniform(0.0, ends.back()), t = random_.uniform(0.0, ends.back());
    if (s > t) std::swap(s, t);
    const auto point = [&](double along) {
      std::size_t part = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), along) - ends.begin());
      part = std::clamp<std::size_t>(part, 1, path_.size() - 1) - 1;
      const double length = ends[part + 1] - ends[part];
      State state(space_.size());
      space_.interpolate(path_[part], path_[part + 1], length > 0.0 ? (along - ends[part]) / length : 0.0, state);
      return std::pair{part, state};
    };
    auto [first, a] = point(s);
    auto [last, b] = point(t);
    if (validity_.is_constrained()) {  // its nodes are near each other
      a = path_[first];
      b = path_[last + 1];
      last += 1;
    }
    return {first, std::move(a), last, std::move(b)};
  }

  double way_length(const State& a, const std::vector<State>& way) const {
    double length = space_.distance(a, way.front());
    for (std::size_t i = 1; i < way.size(); ++i) length += space_.distance(way[i - 1], way[i]);
    return length;
  }

  double length_between(std::size_t first, const State& a, std::size_t last, const State& b) const {
    if (validity_.is_constrained()) {
      double length = 0.0;
      for (std::size_t i = first; i < last; ++i) length += space_.distance(path_[i], path_[i + 1]);
      return length;
    }
    double length = space_.distance(a, path_[first + 1]);
    for (std::size_t i = first + 1; i < last; ++i) length += space_.distance(path_[i], path_[i + 1]);
    return length + space_.distance(path_[last], b);
  }

  bool is_way_valid(const std::vector<State>& way) {
    for (std::size_t i = 1; i + 1 < way.size(); ++i)
      if (!validity_.is_valid(way[i])) return false;
    for (std::size_t i = 1; i < way.size(); ++i)
      if (!can_go(validity_, way[i - 1], way[i])) return false;
    return true;
  }

  // Put states in place of those between two points: path[first + 1] … path[last].
  void replace(std::size_t first, std::size_t last, std::vector<State> way) {
    std::vector<State> path(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(first) + 1);
    const auto add = [&](const State& state) {
      if (space_.distance(path.back(), state) > 1e-9) path.push_back(state);
    };
    for (const State& state : way) add(state);
    const std::size_t goes_on = validity_.is_constrained() ? last : last + 1;
    for (std::size_t i = goes_on; i < path_.size(); ++i) add(path_[i]);
    path.back() = path_.back();
    path_ = std::move(path);
  }

  Validity& validity_;
  const StateSpace& space_;
  std::vector<State>& path_;
  Random& random_;
  const Deadline& deadline_;
};

}  // namespace

double path_length(const StateSpace& space, const std::vector<State>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += space.distance(path[i - 1], path[i]);
  return length;
}

void simplify(Validity& validity, std::vector<State>& path, const SimplifierSettings& settings, Random& random,
              const Deadline& deadline) {
  if (path.size() < 3) return;
  const std::vector<State> direct = direct_way(validity, path.front(), path.back());
  if (!direct.empty()) {
    const State start = path.front();
    path = direct;
    path.insert(path.begin(), start);
    return;
  }
  Simplifier simplifier(validity, path, random, deadline);
  simplifier.drop_waypoints();
  simplifier.shortcut(settings.shortcuts, settings.patience);
  simplifier.shortcut_variable(settings.partial_shortcuts, settings.patience);
  simplifier.drop_waypoints();
  simplifier.cut_corners(settings.cut);
}

int find_invalid_part(Validity& validity, const std::vector<State>& path) {
  for (std::size_t i = 0; i < path.size(); ++i)
    if (!validity.is_valid(path[i])) return static_cast<int>(i > 0 ? i - 1 : 0);
  for (std::size_t i = 1; i < path.size(); ++i)
    if (!validity.is_motion_valid(path[i - 1], path[i], true)) return static_cast<int>(i) - 1;
  return -1;
}

}  // namespace trundle::planning
