#include "correlative_matcher.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "symmetric_solve.h"

namespace trundle::navigation {

namespace {

constexpr int kMaxAngles = 361, kMaxShifts = 801;
constexpr std::size_t kMaxHits = 720;  // of a scan that are looked up
constexpr double kPenalty = 0.2;       // Karto's
constexpr int kMaxSteps = 20;
constexpr double kLongestStep = 0.03, kLargestTurn = 0.02;  // of a Gauss-Newton step [m], [rad]
constexpr double kPointDeviation = 0.05;                    // of a hit from the map, noise and map together [m]
constexpr double kHighest = 255.0;

struct Cell {
  int column, row;
};

// Poses of one angle whose shifts are in a square; its side is 1 << 2 level cells.
struct Candidate {
  double bound;
  double distance;  // least, from the start [cells²]
  int angle, column, row, level;

  // The queue's top is the highest; of equals that of a finer level, then the nearest and first, so that runs repeat.
  bool operator<(const Candidate& other) const {
    if (bound != other.bound) return bound < other.bound;
    if (level != other.level) return level > other.level;
    if (distance != other.distance) return distance > other.distance;
    if (angle != other.angle) return angle > other.angle;
    return row != other.row ? row > other.row : column > other.column;
  }
};

std::size_t stride(const RangeScan& scan) { return scan.hits.size() / (kMaxHits + 1) + 1; }

class Search {
 public:
  Search(const ScoreWindow& window, const RangeScan& scan, const PlanarPose& start, const SearchOptions& options)
      : window_(window), options_(options), start_(start) {
    shifts_ = std::clamp(static_cast<int>(std::lround(options.half_width / window.resolution())), 0, kMaxShifts / 2);
    angles_ =
        options.angle_step > 0.0
            ? std::clamp(static_cast<int>(std::lround(options.half_angle / options.angle_step)), 0, kMaxAngles / 2)
            : 0;
    for (int angle = -angles_; angle <= angles_; ++angle) {
      const Placement place({start.x, start.y, start.yaw + angle * options.angle_step});
      std::vector<Cell>& cells = cells_.emplace_back();
      for (std::size_t i = 0; i < scan.hits.size(); i += stride(scan)) {
        const Point hit = place(scan.hits[i]);
        cells.push_back({window.column_of(hit.x) - shifts_, window.row_of(hit.y) - shifts_});
      }
    }
  }

  ScanMatch run() {
    if (cells_.front().empty()) return {start_, 0.0, {}};
    std::priority_queue<Candidate> queue;
    const int top = ScoreWindow::kLevels - 1;
    const int squares = (2 * shifts_ >> (2 * top)) + 1;
    for (int angle = 0; angle < static_cast<int>(cells_.size()); ++angle)
      for (int row = 0; row < squares; ++row)
        for (int column = 0; column < squares; ++column) queue.push(candidate(angle, column, row, top));
    while (queue.top().level > 0) {
      const Candidate best = queue.top();
      queue.pop();
      const int level = best.level - 1, last = 2 * shifts_ >> (2 * level);
      for (int row = 4 * best.row; row < 4 * best.row + 4; ++row)
        for (int column = 4 * best.column; column < 4 * best.column + 4; ++column)
          if (row <= last && column <= last) queue.push(candidate(best.angle, column, row, level));
    }
    const Candidate& best = queue.top();
    const PlanarPose pose{start_.x + (best.column - shifts_) * window_.resolution(),
                          start_.y + (best.row - shifts_) * window_.resolution(),
                          normalized_angle(start_.yaw + (best.angle - angles_) * options_.angle_step)};
    return {pose, response(best.angle, best.column, best.row, 0), {}};
  }

 private:
  double response(int angle, int column, int row, int level) const {
    int sum = 0;
    const std::vector<Cell>& cells = cells_[static_cast<std::size_t>(angle)];
    for (const Cell& cell : cells)
      sum += window_.highest(level, (cell.column >> (2 * level)) + column, (cell.row >> (2 * level)) + row);
    return sum / (kHighest * static_cast<double>(cells.size()));
  }

  Candidate candidate(int angle, int column, int row, int level) const {
    const auto nearest = [&](int square) {  // to the start, of the square's shifts
      const int first = square << (2 * level), last = std::min(first + (1 << (2 * level)) - 1, 2 * shifts_);
      return static_cast<double>(std::clamp(shifts_, first, last) - shifts_);
    };
    const double across = nearest(column), along = nearest(row);
    const double distance = across * across + along * along;
    double bound = response(angle, column, row, level);
    if (options_.is_penalized) bound *= factor(distance, angle - angles_);
    return {bound, distance, angle, column, row, level};
  }

  double factor(double squared_cells, int angle_steps) const {
    const double squared = squared_cells * window_.resolution() * window_.resolution();
    const double angle = angle_steps * options_.angle_step;
    return std::max(options_.least_distance_factor, 1.0 - kPenalty * squared / options_.distance_variance) *
           std::max(options_.least_angle_factor, 1.0 - kPenalty * angle * angle / options_.angle_variance);
  }

  const ScoreWindow& window_;
  const SearchOptions& options_;
  PlanarPose start_;
  int shifts_, angles_;                   // to each side
  std::vector<std::vector<Cell>> cells_;  // of the hits at each angle, at the least shift
};

struct Equations {
  std::array<double, 6> hessian{};
  std::array<double, 3> gradient{};
  double response = 0.0;
};

void add_outer(std::array<double, 6>& sum, const std::array<double, 3>& j, double weight) {
  const auto [x, y, t] = j;
  const std::array<double, 6> terms{x * x, x * y, y * y, x * t, y * t, t * t};
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * terms[i];
}

Equations equations(const ScoreWindow& window, const RangeScan& scan, const PlanarPose& pose) {
  Equations sums;
  const Placement place(pose);
  std::size_t count = 0;
  for (std::size_t i = 0; i < scan.hits.size(); i += stride(scan), ++count) {
    const Point arm = place.turn(scan.hits[i]);
    const ScoreWindow::Sample sample = window.sample({place.x + arm.x, place.y + arm.y});
    const std::array<double, 3> j{sample.by_x, sample.by_y, sample.by_y * arm.x - sample.by_x * arm.y};
    add_outer(sums.hessian, j, 1.0);
    for (std::size_t k = 0; k < j.size(); ++k) sums.gradient[k] += j[k] * (1.0 - sample.value);
    sums.response += sample.value;
  }
  if (count > 0) sums.response /= static_cast<double>(count);
  return sums;
}

// What the matched hits tell of the pose: each of its distance along the normal of its surface.
std::array<double, 6> information(const ScoreWindow& window, const RangeScan& scan, const PlanarPose& pose) {
  std::array<double, 6> sum{};
  const Placement place(pose);
  for (std::size_t i = 0; i < scan.hits.size(); i += stride(scan)) {
    const Point arm = place.turn(scan.hits[i]), normal = place.turn(scan.normals[i]);
    const double value = window.sample({place.x + arm.x, place.y + arm.y}).value;
    add_outer(sum, {normal.x, normal.y, normal.y * arm.x - normal.x * arm.y},
              value / (kPointDeviation * kPointDeviation));
  }
  return sum;
}

}  // namespace

ScanMatch search(const ScoreWindow& window, const RangeScan& scan, const PlanarPose& start,
                 const SearchOptions& options) {
  return Search(window, scan, start, options).run();
}

ScanMatch refine(const ScoreWindow& window, const RangeScan& scan, const PlanarPose& start) {
  PlanarPose pose = start;
  Equations now = equations(window, scan, pose);
  double length = 1.0;  // of a step, as a part of Gauss-Newton's
  for (int step = 0; step < kMaxSteps && length > 0.05; ++step) {
    std::array<double, 6> damped = now.hessian;
    for (const std::size_t i : {0, 2, 5}) damped[i] = 1.01 * damped[i] + 1e-6;
    auto move = symmetric_product(symmetric_inverse(damped), now.gradient);
    const double longest = std::max(std::hypot(move[0], move[1]) / kLongestStep, std::abs(move[2]) / kLargestTurn);
    if (!std::isfinite(longest)) break;
    const double scale = length / std::max(longest, 1.0);
    const PlanarPose moved{pose.x + scale * move[0], pose.y + scale * move[1],
                           normalized_angle(pose.yaw + scale * move[2])};
    const Equations next = equations(window, scan, moved);
    if (next.response < now.response) {
      length *= 0.5;
      continue;
    }
    pose = moved;
    now = next;
    if (longest * scale < 1e-3) break;
  }
  return {pose, now.response, information(window, scan, pose)};
}

}  // namespace trundle::navigation
