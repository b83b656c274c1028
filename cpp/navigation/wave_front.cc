#include "wave_front.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trundle {

namespace {

constexpr float kShare = 0.7F;  // ratio to the least cost: within it, the order of cells hardly matters
constexpr std::size_t kMaxBuckets = 4096;

bool is_passable(float cost) { return cost > 0 && cost < kUnreached; }

}  // namespace

WaveFront::WaveFront(const float* costs, GridShape shape, const std::vector<std::array<int, 2>>& seeds,
                     std::array<int, 2> stop)
    : costs_(costs), shape_(shape), potential_(shape.size(), kUnreached) {
  float least = kUnreached;
  float most = 0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (!is_passable(costs[i])) continue;
    least = std::min(least, costs[i]);
    most = std::max(most, costs[i]);
  }
  if (most <= 0) most = least = 1;
  width_ = std::max(kShare * least, 2 * most / static_cast<float>(kMaxBuckets));
  buckets_.resize(static_cast<std::size_t>(2 * most / width_) + 3);
  for (const auto& [x, y] : seeds) {
    if (!shape.contains(x, y)) continue;
    potential_[shape.index(x, y)] = 0;
    push(shape.index(x, y));
  }
  std::vector<std::size_t> cells;
  for (; queued_ > 0; ++first_) {
    if (shape.contains(stop[0], stop[1]) &&
        potential_[shape.index(stop[0], stop[1])] < width_ * (static_cast<float>(first_) - 1))
      break;
    auto& bucket = buckets_[first_ % buckets_.size()];
    while (!bucket.empty()) {  // spreading may add to this bucket
      cells.clear();
      cells.swap(bucket);
      queued_ -= cells.size();
      for (const std::size_t cell : cells) spread(cell);
    }
  }
}

void WaveFront::push(std::size_t cell) {
  const auto bucket = std::max(static_cast<std::size_t>(potential_[cell] / width_), first_);
  buckets_[bucket % buckets_.size()].push_back(cell);
  ++queued_;
}

void WaveFront::spread(std::size_t cell) {
  if (static_cast<std::size_t>(potential_[cell] / width_) < first_) return;  // spread from an earlier bucket
  const auto width = static_cast<std::size_t>(shape_.width);
  const int x = static_cast<int>(cell % width);
  const int y = static_cast<int>(cell / width);
  relax(x - 1, y);
  relax(x + 1, y);
  relax(x, y - 1);
  relax(x, y + 1);
}

void WaveFront::relax(int x, int y) {
  if (!shape_.contains(x, y)) return;
  const std::size_t cell = shape_.index(x, y);
  const float cost = costs_[cell];
  if (!is_passable(cost)) return;
  const float across = std::min(at(x - 1, y), at(x + 1, y));
  const float along = std::min(at(x, y - 1), at(x, y + 1));
  const float difference = across - along;
  const float value = std::fabs(difference) >= cost
                          ? std::min(across, along) + cost
                          : (across + along + std::sqrt(2 * cost * cost - difference * difference)) / 2;
  if (value >= potential_[cell] - 1e-4F * cost) return;
  potential_[cell] = value;
  push(cell);
}

namespace {

class Descent {
 public:
  Descent(const float* potential, GridShape shape) : potential_(potential), shape_(shape) {}

  // Moves a point half a cell downhill, or to the lowest neighbor where the slope is unknown; false at the bottom.
  bool step(std::array<double, 2>& point) const {
    const int x = static_cast<int>(std::floor(point[0]));
    const int y = static_cast<int>(std::floor(point[1]));
    const double right = point[0] - x;
    const double up = point[1] - y;
    std::array<double, 2> slope{};
    bool is_known = true;
    for (int i = 0; i < 4 && is_known; ++i) {
      const int column = i % 2;
      const int row = i / 2;
      const double weight = (column ? right : 1 - right) * (row ? up : 1 - up);
      if (weight == 0) continue;
      const auto corner = slope_at(x + column, y + row);
      is_known = std::isfinite(corner[0]);
      for (std::size_t axis = 0; axis < 2; ++axis) slope[axis] += weight * corner[axis];
    }
    const double length = std::hypot(slope[0], slope[1]);
    if (is_known && length > 1e-9) {
      const std::array<double, 2> next{point[0] - 0.5 * slope[0] / length, point[1] - 0.5 * slope[1] / length};
      if (lowest(next) < lowest(point)) {
        point = next;
        return true;
      }
    }
    return step_to_neighbor(point);
  }

  [[nodiscard]] float at(int x, int y) const {
    return shape_.contains(x, y) ? potential_[shape_.index(x, y)] : kUnreached;
  }

 private:
  // Potential at a point, interpolated between cells; unreached beside unreached cells.
  [[nodiscard]] double lowest(std::array<double, 2> point) const {
    const int x = static_cast<int>(std::floor(point[0]));
    const int y = static_cast<int>(std::floor(point[1]));
    const double right = point[0] - x;
    const double up = point[1] - y;
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      const double weight = (i % 2 ? right : 1 - right) * (i / 2 ? up : 1 - up);
      if (weight > 0) sum += weight * static_cast<double>(at(x + i % 2, y + i / 2));
    }
    return sum;
  }

  // Upwind differences: toward the lower neighbor of each axis; not finite in unreached cells.
  [[nodiscard]] std::array<double, 2> slope_at(int x, int y) const {
    const float here = at(x, y);
    if (here >= kUnreached) return {std::numeric_limits<double>::infinity(), 0};
    const auto difference = [here](float before, float after) -> double {
      if (before < after && before < here) return static_cast<double>(here - before);
      return after < here ? static_cast<double>(after - here) : 0.0;
    };
    return {difference(at(x - 1, y), at(x + 1, y)), difference(at(x, y - 1), at(x, y + 1))};
  }

  bool step_to_neighbor(std::array<double, 2>& point) const {
    const int x = static_cast<int>(std::lround(point[0]));
    const int y = static_cast<int>(std::lround(point[1]));
    float best = at(x, y);
    std::array<int, 2> target{x, y};
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const bool cuts_corner = dx && dy && (at(x + dx, y) >= kUnreached || at(x, y + dy) >= kUnreached);
        if (cuts_corner || at(x + dx, y + dy) >= best) continue;
        best = at(x + dx, y + dy);
        target = {x + dx, y + dy};
      }
    }
    const bool is_moving = target[0] != x || target[1] != y;
    point = {static_cast<double>(target[0]), static_cast<double>(target[1])};
    return is_moving;
  }

  const float* potential_;
  GridShape shape_;
};

}  // namespace

std::vector<std::array<double, 2>> descend(const float* potential, GridShape shape, std::array<int, 2> from,
                                           std::array<int, 2> to) {
  const Descent descent(potential, shape);
  if (descent.at(from[0], from[1]) >= kUnreached) return {};
  const std::array<double, 2> end{static_cast<double>(to[0]), static_cast<double>(to[1])};
  std::array<double, 2> point{static_cast<double>(from[0]), static_cast<double>(from[1])};
  std::vector<std::array<double, 2>> path{point};
  for (std::size_t i = 0; i < 4 * shape.size(); ++i) {
    if (std::hypot(point[0] - end[0], point[1] - end[1]) <= 1) {
      path.push_back(end);
      return path;
    }
    if (!descent.step(point)) return {};
    path.push_back(point);
  }
  return {};
}

}  // namespace trundle
