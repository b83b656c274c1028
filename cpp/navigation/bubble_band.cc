#include "bubble_band.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace trundle::navigation {

namespace {

constexpr double kLargest = 1.0;     // radius of a bubble without obstacles around [m]
constexpr double kProbe = 0.05;      // distance at which radii are compared for their gradient [m]
constexpr std::size_t kMost = 2000;  // bubbles
constexpr double kStep = 0.5;        // of the distance to equilibrium

double distance(const Point& a, const Point& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

class Relaxation {
 public:
  Relaxation(const std::vector<Point>& obstacles, const BubbleSettings& settings)
      : obstacles_(obstacles), s_(settings) {}

  std::vector<Bubble> run(const std::vector<Point>& path) {
    for (const Point& point : path) bubbles_.push_back(bubble(point));
    if (!connect()) return {};
    for (int round = 0; round < s_.num_iterations_eband_optimization; ++round) {
      for (int pass = 0; pass < s_.equilibrium_approx_max_recursion_depth; ++pass)
        for (std::size_t i = 1; i + 1 < bubbles_.size(); ++i) move(i);
      if (!connect()) return {};
    }
    return bubbles_;
  }

 private:
  [[nodiscard]] double radius(const Point& center) const {
    double least = kLargest + s_.robot_radius;
    for (const Point& point : obstacles_) least = std::min(least, distance(center, point));
    return least - s_.robot_radius;
  }
  [[nodiscard]] Bubble bubble(const Point& center) const { return {center, radius(center)}; }

  [[nodiscard]] bool overlap(const Bubble& a, const Bubble& b) const {
    return distance(a.center, b.center) <= s_.min_relative_overlap * (a.radius + b.radius);
  }

  // Drops bubbles whose neighbors overlap, and fills gaps; false where a bubble is too small.
  bool connect() {
    std::vector<Bubble> kept{bubbles_.front()};
    for (std::size_t i = 1; i < bubbles_.size(); ++i) {
      const bool is_last = i + 1 == bubbles_.size();
      if (!is_last && overlap(kept.back(), bubbles_[i + 1])) continue;
      if (!fill(kept, bubbles_[i], 8)) return false;
      kept.push_back(bubbles_[i]);
    }
    bubbles_ = std::move(kept);
    return true;
  }

  // Adds bubbles between the last one and another by halving the gap.
  bool fill(std::vector<Bubble>& kept, const Bubble& next, int depth) {
    const Bubble& last = kept.back();
    if (overlap(last, next)) return true;
    // The ends may lie anywhere: the robot drives out of a narrow place.
    const double gap = distance(last.center, next.center);
    if (gap < 2.0 * kProbe) return true;
    if (depth == 0 || kept.size() > kMost) return false;
    const Bubble between = bubble({0.5 * (last.center[0] + next.center[0]), 0.5 * (last.center[1] + next.center[1])});
    if (between.radius < s_.tiny_bubble_expansion) return false;
    if (!fill(kept, between, depth - 1)) return false;
    kept.push_back(between);
    return fill(kept, next, depth - 1);
  }

  // Moves a bubble by its forces: toward its neighbors, and where the space is wider; not along the band.
  void move(std::size_t i) {
    const Bubble& previous = bubbles_[i - 1];
    const Bubble& next = bubbles_[i + 1];
    Bubble& own = bubbles_[i];
    const double back = std::max(distance(own.center, previous.center), 1e-6);
    const double ahead = std::max(distance(own.center, next.center), 1e-6);
    Point force{}, along{};
    for (std::size_t k = 0; k < 2; ++k) {
      const double pull = (previous.center[k] - own.center[k]) / back + (next.center[k] - own.center[k]) / ahead;
      Point high = own.center, low = own.center;
      high[k] += kProbe;
      low[k] -= kProbe;
      const double slope = (radius(high) - radius(low)) / (2.0 * kProbe);
      const double share = std::max(0.0, 1.0 - own.radius / kLargest);
      force[k] = s_.internal_force_gain * pull + s_.external_force_gain * share * slope;
      along[k] = next.center[k] - previous.center[k];
    }
    const double norm = std::hypot(along[0], along[1]);
    if (norm > 1e-6) {
      const double part = (force[0] * along[0] + force[1] * along[1]) / (norm * norm);
      for (std::size_t k = 0; k < 2; ++k) force[k] -= part * along[k];
    }
    if (std::hypot(force[0], force[1]) < s_.significant_force_lower_bound) return;
    const double step = kStep * std::min({own.radius, back, ahead}) / (1.0 + s_.internal_force_gain);
    const Bubble moved = bubble({own.center[0] + step * force[0], own.center[1] + step * force[1]});
    if (moved.radius > std::min(s_.tiny_bubble_expansion, own.radius)) own = moved;
  }

  const std::vector<Point>& obstacles_;
  const BubbleSettings& s_;
  std::vector<Bubble> bubbles_;
};

}  // namespace

std::vector<Bubble> relax_bubbles(const std::vector<Point>& path, const std::vector<Point>& obstacles,
                                  const BubbleSettings& settings) {
  return Relaxation(obstacles, settings).run(path);
}

}  // namespace trundle::navigation
